#include "core/solids/half_spaces.hpp"
#include "core/solids/transform.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"

#include <cmath>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using tests::Random;

namespace {

/// xx x^2 + yy y^2 + zz z^2 + 2 y y + one
QuadricOf<double> quadric(double xx, double yy, double zz, double y, double one) {
    QuadricOf<double> q{};
    q.xx = xx;
    q.yy = yy;
    q.zz = zz;
    q.y = y;
    q.one = one;
    return q;
}

PlaneOf<double> plane(const Vec3d& point, const Vec3d& normal) {
    return {point, normal};
}

std::vector<HalfSpace> moved(const std::vector<PartShape>& shapes, const Transform& by) {
    std::vector<HalfSpace> half_spaces;
    for (const PartShape& shape : shapes)
        half_spaces.push_back({by(of_shape(shape)).shape});
    return half_spaces;
}

Transform any_transform(Random& random) {
    const Vec3d sizes(random.log_uniform(0.1, 10.0), random.log_uniform(0.1, 10.0),
                      -random.log_uniform(0.1, 10.0));
    return Transform::translation(random.cube(100.0))
        .after(Transform::rotation(random.cube(180.0)))
        .after(Transform::scaling(sizes));
}

/// Returns a point moved by a transform.
Vec3d image(const Transform& transform, const Vec3d& point) {
    return std::get<PlaneOf<double>>(
               transform(of_shape(PlaneOf<double>{point, {0.0, 0.0, 1.0}})).shape)
        .point;
}

struct Body {
    const char* name;
    std::vector<PartShape> shapes;
    /// Circles have the radius sqrt(radius^2 + slope y^2 + curvature y).
    double radius, slope, curvature;
};

/// Returns the squared radius of the circle at a height.
double squared_radius(const Body& body, double height) {
    return body.radius * body.radius + body.slope * height * height + body.curvature * height;
}

} // namespace

TEST_CASE("bounds of an ellipsoid's quadratic form are tight") {
    Random random(1);
    for (int round = 0; round < 300; ++round) {
        CAPTURE(round);
        const Transform transform = any_transform(random);
        const Bounds bounds =
            bounds_of_common(moved({quadric(1.0, 1.0, 1.0, 0.0, -1.0)}, transform));
        REQUIRE(is_finite(bounds));
        const auto ellipsoid = std::get<EllipsoidOf<double>>(
            transform(of_shape(EllipsoidOf<double>{
                          Vec3d(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}))
                .shape);
        for (int axis = 0; axis < 3; ++axis) {
            const double reach = length(
                Vec3d(ellipsoid.axis_u[axis], ellipsoid.axis_v[axis], ellipsoid.axis_w[axis]));
            const double center = ellipsoid.center[axis];
            // Rounded coefficients move the ellipsoid a little.
            CHECK(static_cast<double>(bounds.upper[axis]) > center + reach * (1.0 - 1e-9));
            CHECK(static_cast<double>(bounds.lower[axis]) < center - reach * (1.0 - 1e-9));
            CHECK(static_cast<double>(bounds.upper[axis]) < center + reach * 1.001 + 1e-4);
            CHECK(static_cast<double>(bounds.lower[axis]) > center - reach * 1.001 - 1e-4);
        }
    }
}

TEST_CASE("bounds of a quadric between planes contain it") {
    const PartShape above = plane({0.0, -1.0, 0.0}, {0.0, -1.0, 0.0}),
                    below = plane({0.0, 1.0, 0.0}, {0.0, 1.0, 0.0});
    const Body bodies[] = {
        {"cylinder", {quadric(1.0, 0.0, 1.0, 0.0, -1.0), above, below}, 1.0, 0.0, 0.0},
        {"cone", {quadric(1.0, -1.0, 1.0, 0.0, 0.0), above, below}, 0.0, 1.0, 0.0},
        {"hyperboloid", {quadric(1.0, -4.0, 1.0, 0.0, -1.0), above, below}, 1.0, 4.0, 0.0},
        {"paraboloid", {quadric(1.0, 0.0, 1.0, -0.5, 0.0), above, below}, 0.0, 0.0, 1.0}};
    Random random(2);
    for (const Body& sample : bodies)
        for (int round = 0; round < 100; ++round) {
            CAPTURE(sample.name, round);
            const Transform transform = round == 0 ? Transform() : any_transform(random);
            const Bounds bounds = bounds_of_common(moved(sample.shapes, transform));
            REQUIRE(is_finite(bounds));
            for (int i = 0; i < 50; ++i) {
                const double height = random.uniform(-0.999, 0.999);
                const double turn = random.uniform(0.0, 6.28);
                if (squared_radius(sample, height) < 0.0) continue;
                const double radius = 0.999 * std::sqrt(squared_radius(sample, height));
                CHECK(bounds.contains(
                    image(transform, {radius * std::cos(turn), height, radius * std::sin(turn)})));
            }
            if (round > 0) continue;
            for (int axis = 0; axis < 3; ++axis)
                CHECK(bounds.upper[axis] - bounds.lower[axis] < 10.0F);
        }
}

TEST_CASE("an infinite quadric has no bounds") {
    const PartShape cylinder = quadric(1.0, 0.0, 1.0, 0.0, -1.0),
                    cone = quadric(1.0, -1.0, 1.0, 0.0, 0.0);
    const PartShape below = plane({0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}),
                    beside = plane({1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}),
                    other_side = plane({-1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0});
    const auto has_bounds = [](const std::vector<PartShape>& shapes) {
        return is_finite(bounds_of_common(moved(shapes, Transform())));
    };
    CHECK(!has_bounds({cylinder}));
    CHECK(!has_bounds({cylinder, below}));
    CHECK(!has_bounds({cylinder, beside, other_side}));
    CHECK(!has_bounds({cone, below}));
    CHECK(!has_bounds({below, beside, other_side}));
    const HalfSpace outside{quadric(1.0, 1.0, 1.0, 0.0, -1.0), true};
    CHECK(!is_finite(bounds_of_common(std::vector{outside})));
    const HalfSpace inverse{quadric(-1.0, -1.0, -1.0, 0.0, 1.0), true};
    CHECK(is_finite(bounds_of_common(std::vector{inverse})));
}
