#include "core/reference/surface_color.hpp"
#include "core/shapes/shape.hpp"
#include "tests/simd/render/image.hpp"
#include "tests/support/little_scene.hpp"

#include <vector>

using namespace raylane;
using namespace little_scene;

namespace {

const Color red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};

struct TestScene : Builder {
    TestScene() {
        settings.width = 60;
        settings.height = 40;
        camera.from = {0, 0, 9};
        camera.field_of_view = 40.0F;
        background = Color(0.5F);
    }
    Solid part(const PartShape& shape, const Material& material) {
        Solid solid = of_shape(shape);
        solid.material = add_material(material);
        return solid;
    }
    /// Adds parts that the plane z = 0 cuts. Returns the id of the plane.
    ShapeId add_cut(const std::vector<Solid>& parts) {
        Material of_face = luminous(Color(0.25F));
        of_face.pattern.kind = PatternKind::cutaway;
        Solid cut{Made::by_intersection};
        cut.parts = {Solid{Made::by_union}, part(PlaneOf<double>{{0, 0, 0}, {0, 0, 1}}, of_face)};
        cut.parts[0].parts = parts;
        const ShapeId first = add_solid(cut, parts[0].material);
        return first + static_cast<ShapeId>(parts.size());
    }
};

Vec3d color_at(const Scene& scene, ShapeId plane, double x, double y) {
    const Solids::Node& node = scene.solids().node(scene.solids().part_of(plane));
    return color_on(scene, scene.material_of(plane).pattern,
                    {plane, node.kind, node.place, body, {x, y, 0.0}});
}

} // namespace

TEST_CASE("a face of a cut has the colour of the sphere with the smallest power") {
    for (const bool is_reversed : {false, true}) {
        TestScene builder;
        std::vector<Solid> parts = {
            builder.part(SphereOf<double>{{-0.5, 0, 0}, 1}, luminous(red)),
            builder.part(SphereOf<double>{{0.5, 0, 0}, 1}, luminous(green))};
        if (is_reversed) std::swap(parts[0], parts[1]);
        const ShapeId plane = builder.add_cut(parts);
        const Scene scene = builder.finish();
        CHECK(color_at(scene, plane, -0.001, 0.3) == convert<double>(red));
        CHECK(color_at(scene, plane, 0.001, 0.3) == convert<double>(green));
        CHECK(color_at(scene, plane, 0.0, 0.3) == convert<double>(is_reversed ? green : red));
        CHECK(color_at(scene, plane, 1.6, 0.0) == Vec3d(0.25)); // outside of all parts
        tests::check_engines_agree(scene);
    }
}

TEST_CASE("a face of a cut has the colours of all kinds of parts, and their patterns") {
    TestScene builder;
    Material striped = luminous();
    striped.pattern.kind = PatternKind::stripes;
    striped.pattern.colors = {red, blue};
    striped.pattern.size = 0.5F;
    Material image = luminous();
    image.pattern.kind = PatternKind::image;
    image.pattern.image = Texture(1, 1, Texture::Codes{255, 0, 0});
    const ShapeId plane = builder.add_cut(
        {builder.part(BoxOf<double>{{-3, -1, -1}, {1.5, 0, 0}, {0, 2, 0}, {0, 0, 2}}, striped),
         builder.part(CylinderOf<double, Ends::capped>{{-1, 0, 0}, {2, 0, 0}, 0.5},
                      luminous(green)),
         builder.part(EllipsoidOf<double>{{1, 1, 0}, {1, 0, 0}, {0, 0.5, 0}, {0, 0, 1}},
                      luminous(blue)),
         builder.part(SphereOf<double>{{2, -1, 0}, 0.7}, image)});
    const Scene scene = builder.finish();
    CHECK(color_at(scene, plane, -2.75, 0.9) == convert<double>(red));
    CHECK(color_at(scene, plane, -2.25, 0.9) == convert<double>(blue));
    CHECK(color_at(scene, plane, -0.75, 0.0) == convert<double>(green));
    CHECK(color_at(scene, plane, 1.0, 0.9) == convert<double>(blue));
    CHECK(color_at(scene, plane, 2.0, -1.0) == Vec3d(0.25)); // an image is no function of the point
    tests::check_engines_agree(scene);
}

TEST_CASE("faces of few and of many parts have the same colours") {
    const auto scene_of = [](bool are_many, ShapeId& plane) {
        TestScene builder;
        std::vector<Solid> parts;
        for (int i = 0; i < 16; ++i)
            parts.push_back(builder.part(
                SphereOf<double>{{0.7 * (i % 4) - 1.0, 0.6 * (i / 4) - 1.0, 0.2 - 0.05 * i}, 0.6},
                luminous(Color(0.05F * static_cast<float>(i), 0.5F, 0))));
        for (int i = 0; are_many && i < 50; ++i)
            parts.push_back(builder.part(SphereOf<double>{{50.0 + i, 0, 0}, 0.5}, luminous(blue)));
        plane = builder.add_cut(parts);
        return builder.finish();
    };
    ShapeId of_few = no_shape, of_many = no_shape;
    const Scene few = scene_of(false, of_few), many = scene_of(true, of_many);
    for (int x = -20; x <= 20; ++x)
        for (int y = -20; y <= 20; ++y)
            CHECK(color_at(few, of_few, 0.1 * x, 0.1 * y) ==
                  color_at(many, of_many, 0.1 * x, 0.1 * y));
    tests::check_engines_agree(few);
    tests::check_engines_agree(many);
}

TEST_CASE("parts that cut, that have no surface or that others remove give no colour") {
    const auto color = [](const auto& add) {
        TestScene builder;
        Material of_face = luminous(Color(0.25F));
        of_face.pattern.kind = PatternKind::cutaway;
        const Solid plane = builder.part(PlaneOf<double>{{0, 0, 0}, {0, 0, 1}}, of_face);
        const Solid ball = builder.part(SphereOf<double>{{0, 0, 0}, 1}, luminous(red));
        const Solid large = builder.part(SphereOf<double>{{0, 0, 0}, 5}, of_face);
        const Solid blue_ball = builder.part(SphereOf<double>{{0, 0, 0}, 4}, luminous(blue));
        const Solid far_ball = builder.part(SphereOf<double>{{50, 0, 0}, 1}, luminous(green));
        builder.add_solid(add(plane, ball, large, blue_ball, far_ball), plane.material);
        const Scene scene = builder.finish();
        for (ShapeId id = 0; id < scene.shape_count(); ++id)
            if (scene.solids().has(id) && scene.solids().node(scene.solids().part_of(id)).flat)
                return color_at(scene, id, 0.1, 0.2);
        return Vec3d(-1.0);
    };
    using S = const Solid&;
    CHECK(color([](S plane, S ball, S large, S, S) {
              return Solid{.made = Made::by_intersection, .parts = {ball, plane, large}};
          }) == convert<double>(red));
    CHECK(color([](S plane, S ball, S large, S, S) {
              const Solid clipped{.made = Made::by_clip, .parts = {ball, large}};
              return Solid{.made = Made::by_intersection, .parts = {clipped, plane}};
          }) == convert<double>(red));
    CHECK(color([](S plane, S ball, S, S blue_ball, S far_ball) {
              const Solid nothing{.made = Made::by_intersection, .parts = {blue_ball, far_ball}};
              const Solid both{.made = Made::by_union, .parts = {nothing, ball}};
              return Solid{.made = Made::by_intersection, .parts = {both, plane}};
          }) == convert<double>(red));
}

TEST_CASE("a cutaway pattern is the first colour on a shape that is no part") {
    TestScene builder;
    Material material = luminous(green);
    material.pattern.kind = PatternKind::cutaway;
    builder.add_shape(Sphere{{0, 0, 0}, 1}, material);
    const Scene scene = builder.finish();
    tests::check_engines_agree(scene);
    CHECK(tests::image(scene, simd::Engine::vector)[20 * 60 + 30] == green);
}
