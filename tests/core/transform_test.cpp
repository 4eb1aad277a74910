#include "core/reference/containing.hpp"
#include "core/shapes/shapes.hpp"
#include "core/solids/transform.hpp"
#include "tests/oracle/exact.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"

#include <cmath>

using namespace raylane;
using namespace raylane::core;
using Whole = oracle::Exact;
using tests::Random;

namespace {

/// Returns whether no double is nearer.
bool is_nearest(double value, const Whole& exact) {
    const auto distance = [&](double to) {
        const Whole off = exact - Whole(to);
        return off.sign() < 0 ? -off : off;
    };
    const Whole own = distance(value);
    for (const double other : {std::nextafter(value, -HUGE_VAL), std::nextafter(value, HUGE_VAL)})
        if ((distance(other) - own).sign() < 0) return false;
    return true;
}

double any_number(Random& random) {
    return random.uniform(-1.0, 1.0) * random.log_uniform(1e-3, 1e3);
}

template <class Shape>
const Shape& shape_in(const Solid& solid) {
    return std::get<Shape>(solid.shape);
}

Scene scene_of(const Solid& solid) {
    SceneBuilder builder;
    builder.wants_light = false;
    const MaterialIndex material = builder.add_material({});
    if (solid.made == Made::of_shape)
        std::visit([&](const auto& shape) { builder.add(shape, material); }, solid.shape);
    else
        builder.add_solid(solid, material);
    return std::move(builder).build();
}

Transform any_transform(Random& random, bool even) {
    const double scale = random.log_uniform(0.3, 3.0);
    const Vec3d sizes = even ? Vec3d(random.integer(0, 1) == 0 ? scale : -scale)
                             : Vec3d(scale, random.uniform(0.4, 2.0), -random.uniform(0.4, 2.0));
    return Transform::translation(random.cube(5.0))
        .after(Transform::rotation(random.cube(180.0)))
        .after(Transform::scaling(sizes));
}

} // namespace

TEST_CASE("a moved shape has each of its numbers rounded once") {
    Random random(3);
    for (int round = 0; round < 300; ++round) {
        double first[3][4], second[3][4];
        for (auto* rows : {&first, &second})
            for (auto& row : *rows)
                for (double& number : row)
                    number = any_number(random);
        const Transform both = Transform::matrix(second).after(Transform::matrix(first));
        const BoxOf<double> box{
            random.cube(9.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
        Solid solid;
        solid.shape = box;
        const auto moved = shape_in<BoxOf<double>>(both(solid));
        for (int axis = 0; axis < 3; ++axis) {
            Whole corner = second[axis][3], edge;
            for (int k = 0; k < 3; ++k) {
                Whole middle = first[k][3];
                for (int j = 0; j < 3; ++j)
                    middle = middle + Whole(first[k][j]) * Whole(box.corner[j]);
                corner = corner + Whole(second[axis][k]) * middle;
                edge = edge + Whole(second[axis][k]) * Whole(first[k][0]);
            }
            CHECK(is_nearest(moved.corner[axis], corner));
            CHECK(is_nearest(moved.edge_u[axis], edge));
        }
    }
}

TEST_CASE("quarter turns and powers of two are exact") {
    Solid solid;
    solid.shape = CylinderOf<double, Ends::capped>{{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}, 0.7};
    const auto turned =
        shape_in<CylinderOf<double, Ends::capped>>(Transform::rotation({0, 0, 90})(solid));
    CHECK(turned.base == Vec3d(-0.2, 0.1, 0.3));
    CHECK(turned.axis == Vec3d(-0.5, 0.4, 0.6));
    CHECK(turned.radius == 0.7);
    const auto larger = shape_in<CylinderOf<double, Ends::capped>>(
        Transform::scaling(Vec3d(-4.0)).after(Transform::rotation({180, 270, -90}))(solid));
    CHECK(larger.radius == 2.8);
    CHECK(squared_length(larger.axis) == Approx(16.0 * 0.77));
}

TEST_CASE("a moved solid contains the moved points of its inside") {
    Random random(5);
    for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        int inside = 0;
        if constexpr (is_solid<Shape>)
            for (int round = 0; round < 60; ++round) {
                const auto shape = to_doubles(ray_sets::Target<Shape>::make(random, false));
                const Transform transform = any_transform(random, round % 2 == 0);
                Solid solid;
                solid.shape = shape;
                const Solid moved = transform(solid);
                CHECK((moved.made != Made::of_shape) ==
                      (round % 2 == 1 && (kind_of<Shape> == Kind::capped_cylinder ||
                                          kind_of<Shape> == Kind::capped_cone)));
                const Scene scene = scene_of(moved);
                PointSearcher points(scene);
                for (int i = 0; i < 100; ++i) {
                    const ray_sets::SurfacePoint at =
                        ray_sets::Target<Shape>::surface(to_floats(shape), random);
                    const Vec3d point =
                        at.point +
                        random.cube(0.1 * ray_sets::Target<Shape>::size(to_floats(shape)));
                    Solid unit_sphere;
                    unit_sphere.shape = SphereOf<double>{point, 1.0};
                    const Solid sphere = transform(unit_sphere);
                    const Vec3d center = std::visit(
                        [](const auto& s) {
                            if constexpr (requires { s.center; })
                                return s.center;
                            else
                                return Vec3d(0.0);
                        },
                        sphere.shape);
                    std::vector<Containing> found;
                    points.add_containing(center, found);
                    const bool is_in = side_of(shape, point) == Side::inside;
                    inside += is_in ? 1 : 0;
                    CHECK(found.empty() != is_in);
                }
            }
        if constexpr (is_solid<Shape>) CHECK(inside > 300);
    });
}

TEST_CASE("mirrored flat shapes keep their fronts") {
    Solid solid;
    solid.shape = TriangleOf<double>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}; // towards z
    const auto mirrored = shape_in<TriangleOf<double>>(Transform::scaling({-1, 1, 1})(solid));
    CHECK(cross(Vec3d(mirrored.b - mirrored.a), Vec3d(mirrored.c - mirrored.a)).z > 0.0);
    solid.shape = PlaneOf<double>{{0, 0, 1}, {0, 0, 1}};
    CHECK(shape_in<PlaneOf<double>>(Transform::scaling({1, 1, -1})(solid)).normal.z < 0.0);
    CHECK(shape_in<PlaneOf<double>>(Transform::scaling({-1, 2, 1})(solid)).normal.z > 0.0);
}

TEST_CASE("a stretched open cylinder or cone is infinite only as a part") {
    const Transform stretched = Transform::scaling({1, 2, 1});
    const auto moved = [&](const PartShape& shape) {
        Solid solid;
        solid.shape = shape;
        return stretched(Transform::rotation({0, 0, 90})(stretched(solid)));
    };
    Solid ball;
    ball.shape = SphereOf<double>{{0, 0, 5}, 1.0};
    for (const Solid& part : {moved(CylinderOf<double, Ends::open>{{0, 0, 0}, {0, 0, 2}, 0.5}),
                              moved(ConeOf<double, Ends::open>{{0, 0, 0}, {0, 0, 2}, 0.5, 0.4})}) {
        Solid both{Made::by_intersection};
        both.parts = {ball, part};
        const Scene scene = scene_of(both);
        PointSearcher points(scene);
        std::vector<Containing> found;
        points.add_containing({0, 0, 5}, found);
        CHECK(found.size() == 1);
        points.add_containing({0.9, 0, 5.9}, found);
        CHECK(found.size() == 1);
        const Scene alone = scene_of(part);
        CHECK(alone.solids().bounds(0).upper.z < 3.5F);
    }
}

TEST_CASE("a quadric in a box has bounds in any solid") {
    const auto part = [](const PartShape& shape) {
        Solid solid;
        solid.shape = shape;
        return solid;
    };
    QuadricOf<double> pipe{};
    pipe.xx = pipe.yy = 1.0;
    pipe.one = -1.0;
    Solid in_box{Made::by_intersection};
    in_box.parts = {part(pipe), part(BoxOf<double>{{-2, -2, -2}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}})};
    Solid on_floor{Made::by_union};
    on_floor.parts = {in_box, part(PlaneOf<double>{{0, 0, -1}, {0, 0, 1}})};
    const Scene scene = scene_of(on_floor);
    PointSearcher points(scene);
    for (const auto& [point, is_in] : {std::pair{Vec3d(0, 0, 1), true},
                                       {Vec3d(0, 0, 3), false},
                                       {Vec3d(9, 9, -2), true},
                                       {Vec3d(1.5, 0, 0), false}}) {
        std::vector<Containing> found;
        points.add_containing(point, found);
        CHECK(found.empty() != is_in);
    }

    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    Solid endless{Made::by_union};
    endless.parts = {part(pipe), part(SphereOf<double>{{0, 0, 0}, 3.0})};
    CHECK_THROWS_AS(builder.add_solid(endless, material), InvalidValue);
    CHECK(builder.shape_count() == 0);
    CHECK(builder.add_solid(in_box, material) == 0);
}

TEST_CASE("glass without a finite index is refused") {
    SceneBuilder builder;
    Material material;
    material.glass = glass_catalogue()[0].glass;
    CHECK_NOTHROW(builder.add_material(material));
    material.glass.B[0] = 1e308;
    CHECK_THROWS_AS(builder.add_material(material), InvalidValue);
}
