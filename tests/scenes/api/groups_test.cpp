#include "raylane/raylane.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/support/catch.hpp"

#include <limits>
#include <string>
#include <vector>

/// Tests of groups, transforms, generators, and values by name.
using namespace raylane;
using tests::message_of;

namespace {

template <class Action>
std::string refusal_of(const Action& action) {
    return message_of<InvalidValue>(action);
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

TEST_CASE("objects without a material have the default one, which gets an index when it is used") {
    SceneBuilder builder;
    const MaterialIndex red = builder.add_material({.pattern = {.colors = {{1, 0, 0}}}}, "red");
    CHECK(refusal_of([&] {
              builder.add(Sphere{{0, 0, 0}, -1});
          }) == "radius: must be positive, got -1");
    const MaterialIndex blue = builder.add_material({});
    CHECK(blue == 1); // the refused sphere has left no material
    const ShapeId ball = builder.add(Sphere{{0, 0, 0}, 1});
    const ShapeId pair =
        builder.add(Solid(Sphere{{5, 0, 0}, 1}, red) | Solid(Sphere{{5, 1, 0}, 1}));
    const ShapeId solid_id =
        builder.add(Solid(Sphere{{9, 0, 0}, 1}, red) | Solid(Sphere{{9, 1, 0}, 1}, blue));
    Group group;
    group.add(Disc{{0, 5, 0}, {0, 1, 0}, 1});
    group.add(Disc{{0, 6, 0}, {0, 1, 0}, 1}, blue);
    const ShapeId first = builder.add(group);
    CHECK(builder.add(group, red) == first + 2);
    const Scene scene = builder.build();
    CHECK(scene.material_of(ball) == 2);
    CHECK(scene.material_of(pair) == red);
    CHECK(scene.material_of(pair + 1) == 2);
    CHECK(scene.material_of(solid_id + 1) == blue);
    CHECK(scene.material_of(first) == 2);
    CHECK(scene.material_of(first + 1) == blue);
    CHECK(scene.material_of(first + 2) == red);
    CHECK(scene.material_count() == 3);
    CHECK(scene.material_name(red) == "red");
    CHECK(scene.material_name(blue).empty());
}

TEST_CASE("chains of operators on solids do not nest") {
    const auto ball = [](int x) { return Solid(SphereOf<double>{{1.5 * x, 0, 0}, 1}); };
    // Nested unions of 1500 parts would be deeper than 1024 levels.
    Solid many = ball(0), fewer = ball(0);
    for (int i = 1; i < 1500; ++i)
        many = many | ball(i);
    for (int i = 1; i < 1500; ++i)
        fewer = fewer - ball(i);
    SceneBuilder builder;
    CHECK(builder.add(many) == 0);
    CHECK(builder.add(fewer) == 1500);
    // A part of a union with a material keeps it, and the parts that follow do not take it.
    const MaterialIndex a = builder.add_material({}), b = builder.add_material({});
    const ShapeId first = builder.add((ball(0) | ball(1)).of(a) | ball(2), b);
    const Scene scene = builder.build();
    CHECK(scene.material_of(first + 1) == a);
    CHECK(scene.material_of(first + 2) == b);
    CHECK(scene.solid_of(first + 2) == first);
}

TEST_CASE("a group or a generator that is refused adds nothing") {
    SceneBuilder builder;
    Group group;
    group.add(Sphere{{0, 0, 0}, 1});
    CHECK(refusal_of([&] {
              group.add(Sphere{{0, 0, 0}, 0});
          }) == "radius: must be positive, got 0");
    CHECK(group.size() == 1);
    group.add(group);
    CHECK(group.size() == 2);
    group.add(Solid(Quadric{.center = {}, .xx = 1, .one = -1, .lower = {}, .upper = {}}));
    CHECK(refusal_of([&] {
              builder.add(group);
          }).starts_with("objects/2: must be bounded, got an unbounded quadric"));
    CHECK(refusal_of([&] { builder.add(group, 7); }) ==
          "objects/0/material: must be the index of a material, got 7");
    CHECK(refusal_of([&] { builder.add(Lattice{.n = 257}); }) ==
          "n: must be from 1 to 256, got 257");
    CHECK(refusal_of([&] { builder.add(Lattice{.n = 2, .strut_radius = 2e30F}); }) ==
          "strut_radius: must keep all shapes between -1e30 and 1e30");
    CHECK(refusal_of([&] { builder.add(Lattice{.n = 2}, no_material, 3); }) ==
          "material: must be the index of a material, got 3");
    CHECK(refusal_of([&] { builder.add(Sphereflake{.radius = 1e-45F, .depth = 1}); }) ==
          "radius: must be so large that no sphere's radius is 0");
    CHECK(refusal_of([&] { builder.add(Sphereflake{.radius = 6e29F, .depth = 1}); }) ==
          "center: must keep all shapes between -1e30 and 1e30");
    CHECK(builder.shape_count() == 0);
    builder.add(Sphere{{0, 0, 0}, 1});
    CHECK(builder.build().material_count() == 1);
    CHECK(refusal_of([] { solid_of(Group()); }) == "must have at least one member, got none");
}

TEST_CASE("transforms refuse numbers that are out of range") {
    CHECK(refusal_of([] { Transform().scaled(0); }) == "scale/0: must not be 0, got 0");
    CHECK(refusal_of([] { Transform().scaled({1, 0, 1}); }) == "scale/1: must not be 0, got 0");
    CHECK(refusal_of([] { Transform().rotated({0, not_a_number, 0}); }).starts_with("rotate/1: "));
    CHECK(refusal_of([] {
              Transform().translated({0, 0, infinity});
          }).starts_with("translate/2: "));
    CHECK(refusal_of([] {
              Transform({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, not_a_number, 0}}});
          }).starts_with("transform/2/2: "));
    CHECK(refusal_of([] {
              Transform({{{1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}}});
          }) == "transform: must not be singular, got one of determinant 0");
    CHECK(refusal_of([] {
              Solid(SphereOf<double>{{0, not_a_number, 0}, 1}).transformed(Transform().scaled(2));
          }).starts_with("center/1: "));
    Group disc;
    disc.add(Disc{{0, 0, 0}, {0, 1, 0}, 1});
    CHECK(refusal_of([&] {
              disc.transformed(Transform().scaled({1, 2, 1}));
          }) == "scale: must be one number for all axes if the object has a disc");
}

TEST_CASE("a transform rounds each number once") {
    // 0.1 * 3 + 0.9 in real arithmetic, of exactly these doubles, rounded; in steps it is an ulp
    // more.
    const Transform transform = Transform().scaled(3).translated({0.9, 0, 0});
    SceneBuilder builder;
    builder.add(Solid(SphereOf<double>{{0.1, 0, 0}, 1}).transformed(transform));
    const double exact = std::get<SphereOf<double>>(builder.build().shape(0)).center.x;
    const auto sum = static_cast<long double>(0.1) * 3 + static_cast<long double>(0.9);
    CHECK(exact == static_cast<double>(sum));
    CHECK(exact != 0.1 * 3 + 0.9);
}

TEST_CASE("each level of transforms rounds once, in files as in code") {
    const auto center_of = [](const Scene& scene) {
        return std::get<SphereOf<double>>(scene.shape(0)).center.x;
    };
    const auto read = [&](const std::string& object) {
        return center_of(parse(R"({"camera": "auto", "materials": {"m": {}}, "definitions": {"ball":
            {"type": "sphere", "center": [0.1, 0, 0], "radius": 1, "scale": 3}}, "objects": [)" +
                                   object + "]}",
                               "a.json"));
    };
    const auto built = [&](const auto& object) {
        SceneBuilder builder;
        builder.add(object);
        return center_of(builder.build());
    };
    const SphereOf<double> ball{{0.1, 0, 0}, 1};
    Group group;
    group.add(ball);
    const Transform inner = Transform().scaled(3), outer = Transform().translated({0.9, 0, 0});
    // One map: 0.1 * 3 + 0.9 is rounded once.
    const double once = built(group.transformed(inner.then(outer)));
    CHECK(built(Solid(ball).transformed(inner.then(outer))) == once);
    CHECK(read(R"({"type": "sphere", "center": [0.1, 0, 0], "radius": 1, "scale": 3,
                   "translate": [0.9, 0, 0], "material": "m"})") == once);
    // Two maps: 0.1 * 3 is rounded, and then the sum with 0.9.
    const double twice = built(group.transformed(inner).transformed(outer));
    CHECK(once != twice);
    CHECK(twice == 0.1 * 3 + 0.9);
    CHECK(built(Solid(ball).transformed(inner).transformed(outer)) == twice);
    CHECK(built(solid_of(group.transformed(inner)).transformed(outer)) == twice);
    CHECK(read(R"({"type": "group", "translate": [0.9, 0, 0], "material": "m", "objects": [
                   {"type": "sphere", "center": [0.1, 0, 0], "radius": 1, "scale": 3}]})") ==
          twice);
    CHECK(read(R"({"type": "instance", "of": "ball", "translate": [0.9, 0, 0],
                   "material": "m"})") == twice);
    CHECK(read(R"({"type": "union", "translate": [0.9, 0, 0], "material": "m", "objects": [
                   {"type": "sphere", "center": [0.1, 0, 0], "radius": 1, "scale": 3}]})") ==
          twice);
}

TEST_CASE("values by name list the names that exist") {
    CHECK(refusal_of([] { material_preset("gold"); }) ==
          "preset: must be one of \"matte\", \"plastic\", \"metal\", \"mirror\", \"glass\", "
          "\"water\", \"diamond\", got \"gold\"");
    CHECK(
        refusal_of([] { catalogue_glass("BK7"); }).starts_with("glass: must be one of \"N-BK7\""));
    CHECK(refusal_of([] { named_view("above"); }).starts_with("view: must be one of \"front\""));
    for (const char* text : {"", "#12345", "#1234567", "#12345g", "123456"})
        CHECK(refusal_of([&] { color_from_srgb(text); }) ==
              "color: must be \"#rrggbb\", got \"" + std::string(text) + '"');
    CHECK(color_from_srgb("#ffFF00") == Color{1, 1, 0});
    CHECK(refusal_of([] {
              aligned_box({0, 0, 0}, {1, 0, 1});
          }) == "upper/1: must be more than lower's 0, got 0");
}

TEST_CASE("an automatic camera must be in range, and needs a bounded shape") {
    const auto refusal = [](const AutoCamera& camera) {
        SceneBuilder builder;
        builder.add(Sphere{{0, 0, 0}, 1});
        builder.auto_camera = camera;
        return refusal_of([&] { builder.build(); });
    };
    CHECK(refusal({.direction = {}}).starts_with("auto_camera/direction: "));
    CHECK(refusal({.up = {0, 0, 2}}) ==
          "auto_camera/up: must not be 0 or parallel to the direction of view");
    CHECK(refusal({.field_of_view = 180}) ==
          "auto_camera/field_of_view: must be from 0.01 to 179, got 180");
    CHECK(refusal({.zoom = 0}) == "auto_camera/zoom: must be from 0.01 to 1000, got 0");
    CHECK(refusal({.depth_cue = 1}) == "auto_camera/depth_cue: must be from 0 to 0.99, got 1");
    CHECK(refusal({}) == "no error");
    CHECK(refusal({.field_of_view = 0.01F, .zoom = 0.01F, .depth_cue = 0.99F}) == "no error");
    SceneBuilder plane;
    plane.add(Plane{{0, 0, 0}, {0, 1, 0}});
    plane.auto_camera.emplace();
    CHECK(refusal_of([&] { plane.build(); }).starts_with("camera: "));
    CHECK_FALSE(plane.auto_camera); // the builder is empty
}
