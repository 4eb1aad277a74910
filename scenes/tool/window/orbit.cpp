#include "scenes/tool/window/orbit.hpp"

#include "core/numbers/more_functions.hpp"
#include "core/scene/field_of_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace raylane::scenes {

namespace {

using core::Vec3d, core::Vec3f;

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double highest = 89.0;

/// Returns the vector from the point that the camera looks at to the camera.
Vec3d arm_of(const core::Camera& camera) {
    return core::convert<double>(camera.from) - core::convert<double>(camera.at);
}

Vec3d right_of(const core::Camera& camera) {
    return core::normalized(core::cross(core::convert<double>(camera.up), arm_of(camera)));
}

double image_height(const core::Camera& camera) {
    if (camera.projection == core::Projection::orthographic)
        return static_cast<double>(camera.height);
    return 2.0 * core::length(arm_of(camera)) * core::slope_of_view(camera.field_of_view);
}

} // namespace

Orbit::Orbit(core::View start) : start_(std::move(start)), axis_(start_.camera.up) {
    const double sine = core::dot(core::normalized(arm_of(start_.camera)),
                                  core::normalized(core::convert<double>(axis_)));
    elevation_ = core::asin(std::clamp(sine, -1.0, 1.0)) * degrees;
}

core::View Orbit::view() const {
    const Vec3f right = core::convert<float>(right_of(start_.camera));
    return core::turned(core::turned(start_, right, -upwards_), axis_, turn_);
}

void Orbit::turn(double to_the_right, double upwards) {
    turn_ = std::fmod(turn_ + to_the_right, 360.0);
    const double lowest = std::min(-highest - elevation_, 0.0);
    upwards_ = std::clamp(upwards_ + upwards, lowest, std::max(highest - elevation_, 0.0));
}

void Orbit::pan(double to_the_right, double upwards) {
    const core::Camera now = view().camera;
    const Vec3d right = right_of(now), up = core::normalized(core::cross(arm_of(now), right));
    const Vec3d step = image_height(now) * (to_the_right * right + upwards * up);
    const auto moved = [&](Vec3f& point) {
        point = core::convert<float>(core::convert<double>(point) + step);
    };
    moved(start_.camera.from);
    moved(start_.camera.at);
    for (core::Light& light : start_.lights)
        moved(light.position);
}

void Orbit::zoom(double times) {
    core::Camera& camera = start_.camera;
    if (camera.projection == core::Projection::orthographic) {
        camera.height = static_cast<float>(static_cast<double>(camera.height) / times);
        return;
    }
    const Vec3d arm = arm_of(camera);
    camera.from = core::convert<float>(core::convert<double>(camera.at) + 1.0 / times * arm);
    // Linear fog keeps its place at the point that the camera looks at.
    const auto nearer = static_cast<float>(core::length(arm) * (1.0 - 1.0 / times));
    if (start_.fog.kind == core::FogKind::linear) {
        start_.fog.start = std::max(start_.fog.start - nearer, 0.0F);
        start_.fog.end =
            std::max(start_.fog.end - nearer, std::nextafter(start_.fog.start, INFINITY));
    }
}

} // namespace raylane::scenes
