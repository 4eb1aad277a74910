#include "core/scene/scene.hpp"
#include "core/scene/shape_coordinates.hpp"
#include "tests/support/catch.hpp"

#include <numbers>

using namespace raylane::core;

namespace {

/// Returns u and v of a point on a shape that is alone in a scene.
template <class Shape>
Vec3d on(const Shape& shape, const Vec3d& point, Face face = body) {
    SceneBuilder builder;
    builder.wants_light = false;
    builder.add(shape, builder.add_material({}));
    const Scene scene = std::move(builder).build();
    const auto [u, v] = coordinates_on(scene.shapes(), kind_of<Shape>, {0, 0}, face, point);
    return {u, v, 0.0};
}

bool near(const Vec3d& a, double u, double v) {
    return length(a - Vec3d(u, v, 0.0)) < 1e-12;
}

} // namespace

TEST_CASE("a sphere has turns about +y, and latitudes") {
    const Sphere ball{{1, 2, 3}, 2};
    CHECK(near(on(ball, {3, 2, 3}), 0.0, 0.5));
    CHECK(near(on(ball, {1, 2, 1}), 0.25, 0.5)); // counter-clockwise, seen from above
    CHECK(near(on(ball, {-1, 2, 3}), 0.5, 0.5));
    CHECK(near(on(ball, {1, 2, 5}), 0.75, 0.5));
    CHECK(on(ball, {1, 4, 3}).y == 1.0);
    CHECK(on(ball, {1, 0, 3}).y == 0.0);
    CHECK(near(on(ball, {1 + std::numbers::sqrt2, 2 + std::numbers::sqrt2, 3}), 0.0, 0.75));
    const Ellipsoid egg{{0, 0, 0}, {1, 0, 0}, {0, 5, 0}, {0, 0, 2}};
    CHECK(near(on(egg, {0, 0, -2}), 0.25, 0.5));
    CHECK(near(on(egg, {0, 5, 0}), 0.0, 1.0));
}

TEST_CASE("cylinders and cones have turns about their axis, and fractions of it") {
    const OpenCylinder upright{{0, 1, 0}, {0, 4, 0}, 1};
    CHECK(near(on(upright, {1, 2, 0}), 0.0, 0.25));
    CHECK(near(on(upright, {0, 5, -1}), 0.25, 1.0));
    const OpenCylinder lying{{0, 0, 0}, {0, 0, 2}, 1}; // begins to the right of its upward side
    CHECK(near(on(lying, {1, 0, 1}), 0.0, 0.5));
    CHECK(near(on(lying, {0, 1, 1}), 0.25, 0.5));
    const CappedCone cone{{0, 0, 0}, {0, 2, 0}, 1, 0};
    CHECK(near(on(cone, {-0.5, 1, 0}), 0.5, 0.5));
    CHECK(near(on(cone, {-0.25, 0, 0}, base_cap), 0.5, 0.0));
}

TEST_CASE("flat shapes have lengths, radii, weights or fractions of edges") {
    CHECK(near(on(Plane{{0, 0, -9}, {0, 0, 3}}, {4, 5, -9}), 4.0, 5.0));
    CHECK(near(on(Plane{{0, 1, 0}, {0, 1, 0}}, {4, 1, 5}), 4.0, -5.0));
    CHECK(near(on(Plane{{0, 0, 0}, {-1, 0, 0}}, {0, 2, 7}), 7.0, 2.0));
    CHECK(near(on(Plane{{0, 0, 0}, {1, 0, 0}}, {0, 2, 7}), -7.0, 2.0));
    CHECK(near(on(Disc{{1, 0, 0}, {0, 0, 1}, 2}, {2, 1, 0}), 0.5, 0.5));
    const Triangle triangle{{0, 0, 0}, {2, 0, 0}, {0, 4, 0}};
    CHECK(near(on(triangle, {0.5, 2, 0}), 0.25, 0.5));
    const Box box{{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {0, 0, 8}};
    CHECK(near(on(box, {0.5, 3, 8}, 5), 0.25, 0.75)); // of edges u and v
    CHECK(near(on(box, {0, 3, 2}, 0), 0.75, 0.25));   // of edges v and w
    CHECK(near(on(box, {0.5, 4, 2}, 3), 0.25, 0.25)); // of edges w and u
}
