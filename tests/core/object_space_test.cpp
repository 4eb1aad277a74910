#include "core/scene/scene.hpp"
#include "core/scene/shape_coordinates.hpp"
#include "core/solids/group.hpp"
#include "core/solids/object_space.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <random>

using namespace raylane::core;

namespace {

/// Returns the coordinates of a point on a shape that a transform has moved.
Vec3d on_moved(const PartShape& shape, const Transform& transform, const Vec3d& point, Face face,
               const Vec3d& pole) {
    Solid solid = transform(of_shape(shape));
    SpaceMover move_space(transform);
    move_space(solid);
    SceneBuilder builder;
    builder.wants_light = false;
    Material material;
    material.pattern.kind = PatternKind::checker;
    material.pattern.space = PatternSpace::object;
    solid.material = builder.add_material(material);
    builder.add_member(solid);
    const Scene scene = std::move(builder).build();
    const auto space = scene.object_space(0);
    REQUIRE(space);
    const auto [u, v] =
        coordinates_on(scene.shapes(), static_cast<Kind>(solid.shape.index()), {0, 0}, face,
                       transform.columns()[0] * point.x + transform.columns()[1] * point.y +
                           transform.columns()[2] * point.z + transform.origin(),
                       &*space, pole);
    return {u, v, 0.0};
}

Vec3d on(const PartShape& shape, const Vec3d& point, Face face, const Vec3d& pole) {
    return on_moved(shape, Transform(), point, face, pole);
}

bool all_have_spaces(const Solid& solid) {
    if (solid.made == Made::of_shape) return solid.space != nullptr;
    return std::all_of(solid.parts.begin(), solid.parts.end(), all_have_spaces);
}

Transform turned(double x, double y, double z, double factor) {
    return Transform::translation({x, -y, 3 * z})
        .after(Transform::rotation({50 * x, 170 * y, 90 * z}))
        .after(Transform::scaling(Vec3d(factor)));
}

} // namespace

TEST_CASE("coordinates on a shape in object space are those before all transforms") {
    struct Case {
        const char* name;
        PartShape shape;
        Vec3d point;
        Face face = body;
        bool stretches = false; ///< also by transforms that change angles
    };
    const Case cases[] = {
        {"sphere", SphereOf<double>{{1, 2, 3}, 2}, {2, 3, 3 + std::sqrt(2.0)}, body, true},
        {"ellipsoid",
         EllipsoidOf<double>{{1, 2, 3}, {1, 0, 0}, {0, 5, 1}, {0, 0, 2}},
         {1.6, 2, 4.6},
         body,
         true},
        {"cylinder", CylinderOf<double, Ends::capped>{{1, 1, 0}, {1, 4, 0}, 1}, {1.2, 2, 1}},
        {"open cone", ConeOf<double, Ends::open>{{1, 1, 0}, {0.1, 0, 4}, 1, 2}, {2, 0.5, 1}},
        {"plane", PlaneOf<double>{{1, 1, 0}, {0, 1, 2}}, {7, 3, -1}, body, true},
        {"disc", DiscOf<double>{{1, 1, 0}, {1, 0, 0}, 2}, {1, 1.5, 0.5}},
        {"triangle",
         TriangleOf<double>{{1, 1, 0}, {2, 1, 1}, {1, 3, 0}},
         {1.25, 1.5, 0.25},
         body,
         true},
        {"box",
         BoxOf<double>{{1, 1, 0}, {1, 0, 0}, {0, 2, 0}, {0, 1, 3}},
         {1.25, 2.5, 3},
         static_cast<Face>(5),
         true},
    };
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (const Case& each : cases) {
        CAPTURE(each.name);
        for (const Vec3d& pole : {Vec3d(0, 1, 0), Vec3d(1, -2, 0.5)}) {
            const Vec3d before = on(each.shape, each.point, each.face, pole);
            for (int i = 0; i < 20; ++i) {
                const double factor = (i % 2 == 0 ? 1.0 : -1.0) * (1.5 + number(random));
                Transform transform =
                    turned(number(random), number(random), number(random), factor);
                if (each.stretches && i % 3 == 0)
                    transform = transform.after(Transform::scaling({2, -0.5, 1.25}));
                const Vec3d after = on_moved(each.shape, transform, each.point, each.face, pole);
                CHECK(largest_component(after - before) < 1e-11);
            }
        }
    }
}

TEST_CASE("a sphere's axis is its pole, and longitudes are those of a cylinder about it") {
    const SphereOf<double> ball{{1, 2, 3}, 2};
    CHECK(largest_component(on(ball, {3, 2, 3}, body, {1, 0, 0}) - Vec3d(0.0, 1.0, 0.0)) < 0.26);
    CHECK(on(ball, {3, 2, 3}, body, {2, 0, 0}).y == 1.0);
    CHECK(on(ball, {-1, 2, 3}, body, {2, 0, 0}).y == 0.0);
    const CylinderOf<double, Ends::open> around{{-1, 2, 3}, {4, 0, 0}, 2};
    for (const Vec3d& point : {Vec3d(1, 4, 3), Vec3d(1, 2, 5), Vec3d(1, 0, 3)})
        CHECK(std::abs(on(ball, point, body, {2, 0, 0}).x - on(around, point, body, {}).x) < 1e-15);
}

TEST_CASE("points return through all transforms of nested groups") {
    const Transform inner = turned(0.3, -0.7, 0.2, 1.5),
                    outer = turned(-0.9, 0.4, 0.8, 0.3).after(Transform::scaling({1, 2, 3}));
    Solid solid = outer(inner(of_shape(SphereOf<double>{{0, 0, 0}, 1})));
    SpaceMover by_inner(inner), by_outer(outer);
    by_inner(solid);
    by_outer(solid);
    const ObjectSpace expected =
        space_moved_by(outer.after(inner).columns(), outer.after(inner).origin());
    for (const Vec3d& point : {Vec3d(0, 0, 0), Vec3d(1, 2, 3), Vec3d(-9, 5, 0.1)})
        CHECK(largest_component(solid.space->point(point) - expected.point(point)) < 1e-12);
    const Placement placement{{1, 2, 3}, {20, -70, 160}, 2.5};
    const Transform same = transform_of(placement);
    const ObjectSpace of_placement = space_moved_by(placement),
                      of_transform = space_moved_by(same.columns(), same.origin());
    CHECK(largest_component(of_placement.point({5, 6, 7}) - of_transform.point({5, 6, 7})) < 1e-14);
}

TEST_CASE("members of a group with one space share it, and solids keep it") {
    const Transform transform = turned(0.3, -0.7, 0.2, 1.5);
    SpaceMover move_space(transform);
    Solid first = transform(of_shape(SphereOf<double>{{0, 0, 0}, 1})), second = first;
    move_space(first);
    move_space(second);
    CHECK(first.space == second.space);
    // A stretched cylinder becomes a quadric between planes.
    const Solid stretched = Transform::scaling({1, 2, 3})([] {
        Solid cylinder = of_shape(CylinderOf<double, Ends::capped>{{0, 0, 0}, {0, 1, 1}, 1});
        cylinder.space = std::make_shared<const ObjectSpace>();
        return cylinder;
    }());
    REQUIRE(count_parts(stretched) > 1);
    CHECK(all_have_spaces(stretched));
}

TEST_CASE("only shapes whose pattern follows them have a space") {
    SceneBuilder builder;
    builder.wants_light = false;
    const MaterialIndex plain = builder.add_material({}), later = builder.add_placeholder();
    Material checker;
    checker.pattern.kind = PatternKind::checker;
    checker.pattern.space = PatternSpace::object;
    const MaterialIndex follows = builder.add_material(checker);
    const Transform transform = turned(0.3, -0.7, 0.2, 1.5);
    const auto add = [&](MaterialIndex material) {
        Solid solid = transform(of_shape(SphereOf<double>{{double(material), 0, 0}, 1}));
        SpaceMover move_space(transform);
        move_space(solid);
        solid.material = material;
        return builder.add_member(solid);
    };
    const ShapeId a = add(plain), b = add(later), c = add(follows);
    SECTION("materials that come later count") {
        const MaterialIndex named[] = {0, 1, 1};
        builder.renumber_materials(named);
        const Scene scene = std::move(builder).build();
        CHECK_FALSE(scene.object_space(a));
        CHECK(scene.object_space(b));
        CHECK(scene.object_space(c));
    }
    SECTION("materials that never come do not count") {
        const Scene scene = std::move(builder).build();
        CHECK_FALSE(scene.object_space(b));
        CHECK(scene.object_spaces().size() == 1);
    }
}

TEST_CASE("spheres with a pattern in object space keep their positions") {
    for (const bool is_image : {false, true}) {
        SceneBuilder builder;
        builder.wants_light = false;
        Material material;
        material.pattern.kind = is_image ? PatternKind::image : PatternKind::checker;
        material.pattern.image = Texture(1, 1, Texture::Codes(3));
        material.pattern.space = PatternSpace::object;
        builder.add(Sphere{{0, 0, 0}, 1}, builder.add_material(material));
        const Scene scene = std::move(builder).build();
        Workers alone;
        const float positions[] = {1, 2, 3};
        const auto move = [&] { return scene.with_positions<float>(positions, alone); };
        if (is_image)
            CHECK_NOTHROW(move());
        else
            CHECK_THROWS_AS(move(), InvalidValue);
    }
}
