#include "core/scene/pattern.hpp"
#include "tests/places.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/shapes/shapes.hpp"
#include "tests/support/catch.hpp"

#include <limits>

using namespace raylane;
using namespace raylane::tests;
using core::Color;
using core::Vec3d;
using core::Vec3f;

namespace {

core::Material material_of(const std::string& material) {
    const core::Scene scene = scene_of(with_objects(
        R"({"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": )" + material + "}"));
    return scene.material_of(0);
}

} // namespace

TEST_CASE("each shape has the numbers of its file") {
    core::for_each_shape_type([]<class Shape>(std::type_identity<Shape>) {
        CAPTURE(core::name_of(core::kind_of<Shape>));
        const core::Scene scene =
            scene_of(with_objects(object_text(Written<Shape>::text, R"("glass")")));
        REQUIRE(scene.shape_count() == 1);
        CHECK(core::numbers_of(shape<Shape>(scene, 0)) ==
              core::numbers_of(Written<Shape>::template by_name<core::InDouble<Shape>>()));
        CHECK(scene.material_of(0).transmission == 1.0F);
    });
}

TEST_CASE("optional keys of a shape have defaults") {
    const core::Scene scene = scene_of(with_objects(R"(
        {"type": "box", "material": "clay", "min": [-0.1, 0.2, 1], "max": [0.3, 0.7, 1.5]},
        {"type": "cone", "material": "clay", "base": [1, 2, 3], "axis": [0, 5, 0], "base_radius": 0.9},
        {"type": "quadric", "material": "clay", "lower": [-1, -2, -3], "upper": [1, 2, 3],
         "matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -0.1]]})"));
    REQUIRE(scene.shape_count() == 3);
    using core::numbers_of;
    CHECK(numbers_of(shape<core::Box>(scene, 0)) ==
          core::Numbers<core::BoxOf<double>>{-0.1, 0.2, 1, 0.3 - -0.1, 0, 0, 0, 0.7 - 0.2, 0, 0, 0,
                                             0.5});
    CHECK(numbers_of(shape<core::CappedCone>(scene, 1)) ==
          core::Numbers<core::InDouble<core::CappedCone>>{1, 2, 3, 0, 5, 0, 0.9, 0});
    // center; xx, yy, zz, xy, xz, yz, x, y, z, one; lower; upper
    CHECK(numbers_of(shape<core::Quadric>(scene, 2)) ==
          core::Numbers<core::QuadricOf<double>>{0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, -0.1, -1, -2,
                                                 -3, 1, 2, 3});
    for (core::ShapeId id = 0; id < 3; ++id)
        CHECK(scene.material_of(id).transmission == 0.0F);
}

TEST_CASE("numbers of shapes become the nearest doubles and tiny ones the nearest floats") {
    const auto radius = [](const std::string& digits) {
        return shape<core::Sphere>(
                   scene_of(with_objects(
                       R"({"type": "sphere", "material": "clay", "center": [0, 0, 0], "radius": )" +
                       digits + "}")),
                   0)
            .radius;
    };
    CHECK(radius("0.1") == 0.1);
    CHECK(radius("1.000000059604644775390626") == 1.0 + 0x1p-24);
    CHECK(radius("123456789012345678901234567890") == 123456789012345678901234567890.0);
    CHECK(radius("16777217") == 16777217.0);
    CHECK(radius("9007199254740993") == 9007199254740992.0);
    CHECK(radius("1.3e-38") == 1.3e-38);
    CHECK(radius("1e-45") == 0x1p-149);
    CHECK(
        complaint_about_text(with_objects(
            R"({"type": "sphere", "material": "clay", "center": [1e-60, -1e-400, 0], "radius": 1})")) ==
        "");
}

TEST_CASE("other numbers become the nearest floats") {
    const auto index = [](const std::string& digits) {
        return material_of(R"({"index": )" + digits + "}").index;
    };
    // Nearer to 1 + 2^-23 than to 1. The nearest double is half-way and would round to 1.
    CHECK(index("1.000000059604644775390626") == 1.0F + 0x1p-23F);
    CHECK(index("1.000000059604644775390625") == 1.0F);
    CHECK(index("1e-45") == std::numeric_limits<float>::denorm_min());
}

TEST_CASE("materials have defaults and every key has an effect") {
    const core::Material plain = material_of("{}");
    const core::Material defaults;
    CHECK(plain.pattern.kind == core::PatternKind::solid);
    CHECK(plain.pattern.colors[0] == Color(1.0F));
    CHECK(plain.ambient == defaults.ambient);
    CHECK(plain.diffuse == defaults.diffuse);
    CHECK(plain.reflection == core::Reflection::constant);
    CHECK(plain.index == defaults.index);

    const core::Material material =
        material_of(R"({"color": [0.1, 0.2, 0.3], "ambient": 0.2, "diffuse": 0.3, "specular": 0.4,
        "exponent": 50, "reflectivity": 0.6, "transmission": 0.7, "index": 1.33, "absorption": [1, 2, 3.5], "opacity": 0.8, "visible": "inside"})");
    CHECK(material.pattern.colors[0] == Color(0.1F, 0.2F, 0.3F));
    CHECK(material.ambient == 0.2F);
    CHECK(material.diffuse == 0.3F);
    CHECK(material.specular == 0.4F);
    CHECK(material.exponent == 50.0F);
    CHECK(material.reflection == core::Reflection::constant);
    CHECK(material.reflectivity == 0.6F);
    CHECK(material.transmission == 0.7F);
    CHECK(material.index == 1.33F);
    CHECK(material.absorption == Vec3f(1, 2, 3.5F));
    CHECK(material.opacity == 0.8F);
    CHECK(material.visible == core::Visible::inside);

    CHECK(material_of(R"({"reflection": "schlick"})").reflection == core::Reflection::schlick);
    CHECK(material_of(R"({"reflection": "dielectric"})").reflection ==
          core::Reflection::dielectric);
    CHECK(material_of(R"({"visible": "outside"})").visible == core::Visible::outside);
    CHECK(material_of(R"({"visible": "both"})").visible == core::Visible::both);
}

TEST_CASE("a material has the pattern of its file") {
    const core::Pattern checker =
        material_of(
            R"({"pattern": {"type": "checker", "colors": [[1, 0, 0], [0, 1, 0]], "size": 0.3, "axes": "xyz"}})")
            .pattern;
    CHECK(checker.kind == core::PatternKind::checker);
    CHECK(checker.colors[0] == Color(1, 0, 0));
    CHECK(checker.colors[1] == Color(0, 1, 0));
    CHECK(checker.size == 0.3F);
    CHECK(checker.axes == 7);
    CHECK(
        material_of(
            R"({"pattern": {"type": "checker", "colors": ["#000000", "#ffffff"], "size": 1, "upper_edges": "xz"}})")
            .pattern.axes == (5 | 5 << 3));
    CHECK(material_of(
              R"({"pattern": {"type": "checker", "colors": [[1, 0, 0], [0, 1, 0]], "size": 1}})")
              .pattern.axes == 5);

    const core::Pattern stripes =
        material_of(
            R"({"pattern": {"type": "stripes", "colors": ["#000000", "#ffffff"], "width": 0.3, "direction": [1, 1, 0]}})")
            .pattern;
    CHECK(stripes.kind == core::PatternKind::stripes);
    CHECK(stripes.colors[0] == Color(0.0F));
    CHECK(stripes.colors[1] == Color(1.0F));
    CHECK(stripes.size == 0.3F);
    CHECK(stripes.direction == Vec3f(1, 1, 0));

    const core::Pattern gradient =
        material_of(
            R"({"pattern": {"type": "gradient", "colors": [[1, 0, 0], [0, 1, 0]], "from": [0, 1, 2], "to": [3, 4, 5]}})")
            .pattern;
    CHECK(gradient.kind == core::PatternKind::gradient);
    CHECK(gradient.from == Vec3f(0, 1, 2));
    CHECK(gradient.to == Vec3f(3, 4, 5));

    const core::Pattern formula =
        material_of(R"({"pattern": {"type": "formula", "color": ["x ^ 2", "y", 0.5]}})").pattern;
    CHECK(formula.kind == core::PatternKind::formula);
    CHECK(formula.formula.texts() == core::FormulaTexts{"x ^ 2", "y", "0.5"});
    CHECK(core::color_at(formula, Vec3d(3, 1, 9)) == Vec3d(9, 1, 0.5));
}

TEST_CASE("a formula's transform moves it as it moves an object") {
    const auto formula = [](const std::string& keys) {
        return material_of(R"({"pattern": {"type": "formula", "color": ["x", "y", "z"], )" + keys +
                           "}}")
            .pattern;
    };
    const core::Pattern moved =
        formula(R"("scale": 2, "rotate": [0, 90, 0], "translate": [5, -6, 7])");
    CHECK(moved.formula.texts() ==
          core::FormulaTexts{"(-0.5 * (z - 7))", "(0.5 * (y + 6))", "(0.5 * (x - 5))"});
    // (1, 2, 3) becomes (2, 4, 6), then (6, 4, -2), then (11, -2, 5).
    CHECK(core::color_at(moved, Vec3d(11, -2, 5)) == Vec3d(1, 2, 3));
    CHECK(formula(R"("translate": [0, 0, 1])").formula.texts() ==
          core::FormulaTexts{"x", "y", "((z - 1))"});
    const core::Pattern turned =
        formula(R"("transform": [[1, 2, 0, 1], [0, 1, 3, -2], [1, 0, 1, 4]])");
    const Vec3d color = core::color_at(turned, Vec3d(1 + 4 + 1, 2 + 9 - 2, 1 + 3 + 4));
    CHECK(core::length(color - Vec3d(1, 2, 3)) < 1e-14);
}

TEST_CASE("a back plane is the formula of the birthday scene's wall") {
    const core::Pattern wall = material_of(R"({"pattern": {"type": "back-plane"}})").pattern;
    REQUIRE(wall.kind == core::PatternKind::formula);
    scenes::InputFile file(std::filesystem::path(RAYLANE_SOURCE_DIR "/scenes/birthday.json"));
    const core::Scene birthday = scenes::read_json(file);
    CHECK(wall.formula == birthday.materials()[0].pattern.formula);
    const auto color = [&](double x, double y) { return core::color_at(wall, Vec3d(x, y, -42)); };
    const auto is_near = [](const Vec3d& a, double r, double g, double b) {
        return core::length(a - Vec3d(r, g, b)) < 1e-15;
    };
    CHECK(is_near(color(3, 4), 1, 0.2, 0));
    CHECK(is_near(color(3, -4), 0.7, 0.2, 0));
    CHECK(is_near(color(12, 2.4), 1, 0.2, 0)); // 144 + 5.76 < 150
    // 144 + 6.25 >= 150
    CHECK(is_near(color(12, 2.5), std::abs(std::cos(12.0)), std::abs(std::sin(std::sqrt(2.5))),
                  std::abs(std::cos(std::sqrt(2.5)))));
    CHECK(is_near(color(12, -2.5), 0, 0, std::abs(std::cos(2.5))));
}
