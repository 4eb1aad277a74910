#include "core/scene/formula.hpp"
#include "tests/simd/render/image.hpp"
#include "tests/support/little_scene.hpp"

using namespace raylane;
using namespace little_scene;

namespace {

/// Returns a material that shows a formula in any light.
Material shows(const FormulaTexts& texts) {
    Material material = luminous();
    material.pattern.kind = PatternKind::formula;
    material.pattern.formula = Formula(texts);
    return material;
}

} // namespace

TEST_CASE("both engines show formulas of points and of coordinates on shapes") {
    Builder builder;
    builder.settings.width = 60;
    builder.settings.height = 40;
    builder.camera.from = {3, 4, 9};
    builder.camera.at = {0, 0.5F, 0};
    builder.background = Color(0.5F);
    const MaterialIndex on_shape = builder.add_material(
        shows({"abs(sin(6 * pi * u))", "v", "0.5 + 0.5 * noise(9 * u, 9 * v, z)"}));
    const MaterialIndex in_space = builder.add_material(
        shows({"abs(cos(x))", "abs(sin(sqrt(abs(y))))", "mod(x + z, 2) < 1 ? 0.2 : 1"}));
    builder.add(Plane{{0, -1, 0}, {0, 1, 0}}, in_space);
    builder.add(Sphere{{-2, 0, 0}, 1}, on_shape);
    builder.add(CappedCylinder{{0, -1, 0}, {0.5F, 2, 0}, 0.5F}, on_shape);
    builder.add(CappedCone{{2, -1, 0}, {0, 2, 0}, 0.7F, 0.2F}, on_shape);
    builder.add(Box{{-1, -1, 2}, {1, 0, 0.5F}, {0, 1, 0}, {-0.5F, 0, 1}}, on_shape);
    builder.add(Ellipsoid{{2.5F, 1, 2}, {1, 0, 0}, {0, 0.3F, 0.1F}, {0, 0, 0.6F}}, on_shape);
    builder.add(Disc{{-2, 2, -1}, {0, 0.1F, 1}, 1}, on_shape);
    builder.add(Triangle{{0, 1.5F, 0}, {1, 1.5F, 0}, {0, 2.5F, 0}}, on_shape);
    builder.add(Sphere{{0.5F, 0, 3}, 0.4F}, builder.add_material(mirror()));
    tests::check_engines_agree(builder.finish());
}

TEST_CASE("a formula's colour is that of the point where a ray hits") {
    Builder builder;
    builder.add_shape(Plane{{0, 0, -2}, {0, 0, 1}}, shows({"x + 10 * y", "u", "-z"}));
    const Vec3d color = color_along<double>(builder.finish(), {0.25, 0.5, 1}, {0, 0, -1});
    CHECK(color == Vec3d(5.25, 0.25, 2));
}

TEST_CASE("faces along the axes have no noise in formulas with steps") {
    Builder builder;
    builder.settings.width = builder.settings.height = 60;
    builder.camera.from = {0.3F, 0.7F, 9};
    const std::string cells = "mod(floor(x) + floor(y) + floor(z), 2)";
    builder.add_shape(Box{{-3, -3, -3}, {6, 0, 0}, {0, 6, 0}, {0, 0, 3}},
                      shows({cells, "z == 0", "0"}));
    builder.add_shape(Plane{{0, 0, -4}, {0, 0, 1}}, shows({cells, "z == -4", "0"}));
    const Scene scene = builder.finish();
    for (const simd::Engine engine : {simd::Engine::vector, simd::Engine::reference})
        for (const Color& color : tests::image(scene, engine))
            CHECK(color.y == 1.0F);
    tests::check_engines_agree(scene);
}
