#include "core/solids/group.hpp"
#include "tests/simd/render/image.hpp"
#include "tests/support/little_scene.hpp"

#include <algorithm>
#include <vector>

using namespace raylane;
using namespace little_scene;

namespace {

Texture stars() {
    Texture::Codes codes;
    for (int i = 0; i < 12 * 8 * 3; ++i)
        codes.push_back(static_cast<std::uint8_t>(i * i * 37 % 251));
    return {12, 8, codes};
}

Material image(float width = 1.0F, ImageWrap wrap = ImageWrap::repeat) {
    Material material = luminous();
    material.pattern.kind = PatternKind::image;
    material.pattern.image = stars();
    material.pattern.width = width;
    material.pattern.wrap = wrap;
    return material;
}

Material follows(PatternKind kind, const FormulaTexts& formula = {}) {
    Material material = luminous();
    material.pattern.kind = kind;
    material.pattern.colors = {Color(0.2F, 0.4F, 0.6F), Color(1.0F)};
    material.pattern.size = 0.37F;
    material.pattern.axes = 7;
    material.pattern.space = PatternSpace::object;
    if (kind == PatternKind::formula) material.pattern.formula = Formula(formula);
    return material;
}

const FormulaTexts wood = {"0.5 + 0.5 * noise(3 * x, 3 * y, 3 * z)", "abs(x)", "u < 0.5 ? v : z"};

struct TestScene : Builder {
    TestScene() {
        settings.width = 60;
        settings.height = 40;
        camera.from = {3, 4, 9};
        camera.at = {0, 0.5F, 0};
        background = Color(0.5F);
    }
};

std::vector<Solid> shapes(const std::vector<MaterialIndex>& materials) {
    std::vector<Solid> solids = {
        of_shape(SphereOf<double>{{-2, 0, 0}, 1}),
        of_shape(CylinderOf<double, Ends::capped>{{0, -1, 0}, {0.5, 2, 0}, 0.5}),
        of_shape(ConeOf<double, Ends::open>{{2, -1, 0}, {0, 2, 0}, 0.7, 0.2}),
        of_shape(BoxOf<double>{{-1, -1, 2}, {1, 0, 0.5}, {0, 1, 0}, {-0.5, 0, 1}}),
        of_shape(EllipsoidOf<double>{{2.5, 1, 2}, {1, 0, 0}, {0, 0.3, 0.1}, {0, 0, 0.6}}),
        of_shape(DiscOf<double>{{-2, 2, -1}, {0, 0.1, 1}, 1}),
        of_shape(TriangleOf<double>{{0, 1.5, 0}, {1, 1.5, 0}, {0, 2.5, 0}}),
        of_shape(PlaneOf<double>{{0, -2, 0}, {0, 1, 0}}),
    };
    for (std::size_t i = 0; i < solids.size(); ++i)
        solids[i].material = materials[i % materials.size()];
    return solids;
}

} // namespace

TEST_CASE("both engines show images and patterns in object space on transformed shapes") {
    TestScene builder;
    const std::vector<MaterialIndex> materials = {
        builder.add_material(image()),
        builder.add_material(follows(PatternKind::checker)),
        builder.add_material(follows(PatternKind::formula, wood)),
        builder.add_material(image(0.4F, ImageWrap::clamp)),
        builder.add_material(follows(PatternKind::gradient)),
        builder.add_material(follows(PatternKind::stripes)),
        builder.add_material(mirror(0.5F))};
    const Transform transform =
        Transform::translation({0.3, 0.2, 0}).after(Transform::rotation({10, 40, -20}));
    SpaceMover move_space(transform);
    for (const Solid& solid : shapes(materials)) {
        Solid moved = transformed_member(solid, transform);
        move_space(moved);
        builder.add_member(moved);
    }
    tests::check_engines_agree(builder.finish());
}

TEST_CASE("both engines show the same bits where they agree on the points") {
    const Transform transform =
        Transform::translation({0.25, 1, 0}).after(Transform::rotation({90, 0, 180}));
    for (const Material& material :
         {image(0.37F), image(0.7F, ImageWrap::clamp), follows(PatternKind::checker),
          follows(PatternKind::formula, {"abs(sin(9 * x)) + y", "noise(u, 3 * v, z)", "v"})}) {
        TestScene builder;
        builder.camera.projection = Projection::orthographic;
        builder.camera.from = {0, 0, 5}; // the wall is 5 away from each ray's start
        builder.camera.at = {0, 0, 0};
        builder.camera.height = 4;
        Solid wall = transform(of_shape(PlaneOf<double>{{0, 0, 0}, {0, 1, 0}}));
        SpaceMover move_space(transform);
        move_space(wall);
        wall.material = builder.add_material(material);
        builder.add_member(wall);
        const Scene scene = builder.finish();
        REQUIRE(scene.object_spaces().size() == 1);
        const auto vector = tests::image(scene, simd::Engine::vector),
                   reference = tests::image(scene, simd::Engine::reference);
        CHECK(std::ranges::count(vector, vector.front()) < std::ssize(vector));
        CHECK((vector == reference));
    }
}

TEST_CASE("a pattern in object space moves with its object") {
    const Transform transform =
        Transform::translation({0.5, -0.25, 1}).after(Transform::rotation({90, 0, 90}));
    for (const Material& material : {image(), image(0.3F), follows(PatternKind::checker),
                                     follows(PatternKind::formula, wood)}) {
        const auto color = [&](bool moves) {
            Builder builder;
            Solid ball = of_shape(SphereOf<double>{{0, 0, 0}, 1});
            ball.material = builder.add_material(material);
            Vec3d origin(0.3, 0.2, 5), direction(0, 0, -1);
            if (moves) {
                ball = transform(ball);
                SpaceMover move_space(transform);
                move_space(ball);
                const auto turned = [&](const Vec3d& v) {
                    return v.x * transform.columns()[0] + v.y * transform.columns()[1] +
                           v.z * transform.columns()[2];
                };
                origin = turned(origin) + transform.origin();
                direction = turned(direction);
            }
            builder.add_member(ball);
            return color_along<double>(builder.finish(), origin, direction);
        };
        CHECK(largest_component(color(true) - color(false)) < 1e-9);
    }
}

TEST_CASE("a pattern in the space of the scene stays when its object moves") {
    Material material = follows(PatternKind::formula, {"x", "y", "2 + z"});
    material.pattern.space = PatternSpace::world;
    Builder builder;
    Solid ball = of_shape(SphereOf<double>{{0, 0, 0}, 1});
    ball.material = builder.add_material(material);
    const Transform transform = Transform::rotation({90, 0, 90});
    ball = transform(ball);
    SpaceMover move_space(transform);
    move_space(ball);
    builder.add_member(ball);
    const Vec3d color = color_along<double>(builder.finish(), {0, 0.6, 5}, {0, 0, -1});
    CHECK(length(color - Vec3d(0, 0.6, 2.8)) < 0x1p-27); // formulas round points to 2^-28
}

TEST_CASE("kept copies have the same patterns as shapes, to the bit") {
    const auto scene = [](std::size_t keep_from) {
        TestScene builder;
        builder.keep_from = keep_from;
        const MaterialIndex globe = builder.add_material(image()),
                            grain = builder.add_material(follows(PatternKind::formula, wood)),
                            cells = builder.add_material(follows(PatternKind::checker));
        const Transform inner = Transform::rotation({0, 0, 30});
        SpaceMover move_space(inner);
        std::vector<Solid> members = {
            of_shape(SphereOf<double>{{-1, 0, 0}, 0.7}),
            of_shape(CylinderOf<double, Ends::capped>{{0, -1, 0}, {0.5, 2, 0}, 0.4}),
            of_shape(SphereOf<double>{{1, 0.5, 0}, 0.6})};
        const MaterialIndex materials[] = {globe, grain, cells};
        for (int i = 0; i < 3; ++i) {
            members[i] = inner(members[i]);
            move_space(members[i]);
            members[i].material = materials[i];
        }
        builder.add_copies(members, {{{0, 0, 0}, {0, 0, 0}, 1.0},
                                     {{2, 1, -1}, {40, 100, 250}, 0.8},
                                     {{-2, 1.5, 0.5}, {90, 10, -30}, 1.3}});
        return builder.finish();
    };
    const Scene kept = scene(1), shapes = scene(1000);
    REQUIRE(kept.copies() != nullptr);
    REQUIRE(shapes.copies() == nullptr);
    const auto of_kept = tests::image(kept, simd::Engine::vector);
    CHECK(of_kept == tests::image(shapes, simd::Engine::vector));
    tests::check_engines_agree(kept);
}

TEST_CASE("copies that become shapes keep their patterns") {
    const auto scene = [](bool has_solid, std::size_t keep_from) {
        TestScene builder;
        builder.keep_from = keep_from;
        Solid ball = of_shape(SphereOf<double>{{1, 0, 0}, 0.7});
        ball.material = builder.add_material(image());
        builder.add_copies({&ball, 1},
                           {{{0, 0, 0}, {0, 0, 0}, 1.0}, {{2, 1, -1}, {40, 9, 2}, 0.8}});
        const auto far_away = [&](double x) {
            return of_shape(SphereOf<double>{{x, 500, 0}, 0.1});
        };
        Solid solid{Made::by_union};
        solid.parts = {far_away(0), far_away(0.1)};
        if (has_solid) builder.add_solid(solid, builder.add_material(black()));
        return builder.finish();
    };
    const Scene given_up = scene(true, 1);
    CHECK(given_up.copies() == nullptr);
    CHECK(given_up.object_spaces().size() == 2);
    CHECK(tests::image(given_up, simd::Engine::vector) ==
          tests::image(scene(false, 1), simd::Engine::vector));
}

TEST_CASE("parts of solids have their own patterns in object space") {
    TestScene builder;
    Solid solid{Made::by_difference};
    solid.parts = {of_shape(BoxOf<double>{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}),
                   of_shape(SphereOf<double>{{1, 1, 1}, 1.2})};
    solid.parts[0].material = builder.add_material(follows(PatternKind::formula, wood));
    solid.parts[1].material = builder.add_material(image(0.25F));
    const Transform transform =
        Transform::rotation({0, 25, 0}).after(Transform::scaling({1, 1.5, 1}));
    solid = transform(solid);
    SpaceMover move_space(transform);
    move_space(solid);
    builder.add_member(solid);
    const Scene scene = builder.finish();
    CHECK(scene.object_spaces().size() == 2);
    tests::check_engines_agree(scene);
}
