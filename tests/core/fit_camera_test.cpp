#include "core/scene/fit_camera.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace raylane::core;
using raylane::ray_sets::Random;

namespace {

struct Ball {
    Vec3d center;
    double radius;
};

/// How far balls reach towards each edge of the image: 1 is at the edge.
struct Extent {
    double right = -9.0, left = -9.0, above = -9.0, below = -9.0;

    double most() const { return std::max({right, left, above, below}); }
    static void include(double& side, double reach) { side = std::max(side, reach); }
};

Extent extent_of(const Camera& camera, double aspect, const std::vector<Ball>& balls) {
    const Vec3d from = convert<double>(camera.from);
    const Vec3d to = convert<double>(camera.at) - from;
    const Vec3d forward = 1.0 / length(to) * to;
    const Vec3d across = cross(forward, convert<double>(camera.up));
    const Vec3d right = 1.0 / length(across) * across, up = cross(right, forward);
    Extent extent;
    for (const Ball& ball : balls) {
        const Vec3d w = ball.center - from;
        const double depth = dot(w, forward);
        CHECK(depth > ball.radius);
        const auto reach = [&](double place, double half) {
            if (camera.projection == Projection::orthographic) return (place + ball.radius) / half;
            // The tangent of the angle to the ball's far side.
            const double angle =
                std::atan2(place, depth) + std::asin(ball.radius / std::hypot(place, depth));
            return std::tan(angle) / half;
        };
        const double half_height =
            camera.projection == Projection::orthographic
                ? 0.5 * static_cast<double>(camera.height)
                : std::tan(static_cast<double>(camera.field_of_view) * std::numbers::pi / 360.0);
        extent.include(extent.right, reach(dot(w, right), aspect * half_height));
        extent.include(extent.left, reach(-dot(w, right), aspect * half_height));
        extent.include(extent.above, reach(dot(w, up), half_height));
        extent.include(extent.below, reach(-dot(w, up), half_height));
    }
    return extent;
}

bool projection_is_limited(const FitCamera& fit_camera, double near, double size) {
    return fit_camera.projection == Projection::perspective && near < 1.001 * size / 64;
}

} // namespace

TEST_CASE("a camera that frames balls shows all of them as large as possible") {
    Random random(20261125);
    for (int round = 0; round < 200; ++round) {
        FitCamera fit_camera;
        fit_camera.projection = round % 2 == 0 ? Projection::perspective : Projection::orthographic;
        fit_camera.direction = convert<float>(
            Vec3d(random.uniform(-1, 1), random.uniform(-0.9, 0.9), random.uniform(0.1, 1)));
        fit_camera.field_of_view = static_cast<float>(random.uniform(5, 100));
        const double aspect = random.log_uniform(0.25, 4.0);
        std::vector<Ball> balls;
        const double size = random.log_uniform(1e-3, 1e3);
        Frame frame(fit_camera, aspect);
        for (int i = 0; i < 30; ++i) {
            balls.push_back(
                {size * Vec3d(random.uniform(-3, 9), random.uniform(-1, 1), random.uniform(-2, 2)),
                 size * random.uniform(0, 0.5)});
            frame.include(balls.back().center, balls.back().radius);
        }
        const Extent extent = extent_of(frame.camera(), aspect, balls);
        CAPTURE(round, extent.right, extent.left, extent.above, extent.below);
        CHECK(extent.most() < 1.0 / 1.05 + 1e-4);
        const auto [near, far] = frame.depths(frame.camera());
        CHECK(near > 0.0);
        CHECK(far > near);
        // A wide field of view may need a larger distance, so that everything is in front of the
        // eye.
        if (projection_is_limited(fit_camera, near, std::max(far - near, frame.width()))) continue;
        // The margin is exact on both sides of one direction.
        CHECK(extent.most() == Approx(1.0 / 1.05).epsilon(1e-4));
        const bool fills_width =
            std::abs(extent.right - extent.left) < 1e-4 && extent.right > extent.most() - 1e-4;
        const bool fills_height =
            std::abs(extent.above - extent.below) < 1e-4 && extent.above > extent.most() - 1e-4;
        CHECK((fills_width || fills_height));

        fit_camera.zoom = 2.0F;
        Frame nearer(fit_camera, aspect);
        for (const Ball& ball : balls)
            nearer.include(ball.center, ball.radius);
        CHECK(extent_of(nearer.camera(), aspect, balls).most() == Approx(2.0 / 1.05).epsilon(1e-4));
    }
}

TEST_CASE("a point and a box and an empty frame have cameras") {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        FitCamera fit_camera;
        fit_camera.projection = projection;
        Frame nothing(fit_camera, 1.0);
        CHECK(nothing.empty());
        nothing.include(Bounds{});
        CHECK(nothing.empty());
        CHECK(nothing.camera().from.z > 0.0F);
        Frame point(fit_camera, 1.0);
        point.include(Vec3d(3, 4, 5), 0.0);
        CHECK(point.camera().from != point.camera().at);
        CHECK(point.camera().at.x == 3.0F);
        Frame box(fit_camera, 2.0);
        box.include(Bounds{Vec3f(-1, -2, -3), Vec3f(1, 2, 3)});
        CHECK(box.width() == 4.0);
        CHECK(box.camera().from.z > 3.0F);
    }
}
