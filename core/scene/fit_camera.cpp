#include "core/scene/fit_camera.hpp"

#include "core/scene/field_of_view.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::core {

namespace {

/// Size of the image relative to the size of its contents.
constexpr double margin = 1.05;
/// Minimum distance of the eye from the nearest point, relative to the size of the contents.
constexpr double closest = 0x1p-6;

constexpr float sideways = 0.5F;
constexpr NamedView views[] = {
    {"front", {0, 0, -1}, {0, 1, 0}}, {"back", {0, 0, 1}, {0, 1, 0}},
    {"right", {-1, 0, 0}, {0, 1, 0}}, {"left", {1, 0, 0}, {0, 1, 0}},
    {"top", {0, -1, 0}, {0, 0, -1}},  {"bottom", {0, 1, 0}, {0, 0, 1}},
    {"x", {-1, 0, 0}, {0, 0, 1}},     {"y", {0, -1, 0}, {0, 0, 1}},
    {"z", {0, 0, -1}, {0, 1, 0}},     {"corner", {-1, -sideways, -0.7F}, {0, 1, 0}},
};

} // namespace

std::span<const NamedView> named_views() {
    return views;
}

/// Returns y, or -z if the direction is almost along y.
Vec3f upright(const Vec3f& direction) {
    const Vec3d d = convert<double>(direction);
    const bool is_steep = std::abs(d.y) > 100.0 * std::sqrt(d.x * d.x + d.z * d.z);
    return is_steep ? Vec3f(0, 0, -1) : Vec3f(0, 1, 0);
}

FitCamera fit_camera_of(const Camera& camera) {
    return {.projection = camera.projection,
            .direction = convert<float>(convert<double>(camera.at) - convert<double>(camera.from)),
            .up = camera.up,
            .field_of_view = camera.field_of_view};
}

Frame::Frame(const FitCamera& fit_camera, double aspect)
    : fit_camera_(fit_camera), aspect_(aspect) {
    const Vec3d direction = convert<double>(fit_camera.direction);
    back_ = -1.0 / length(direction) * direction;
    const Vec3d across = cross(convert<double>(fit_camera.up), back_);
    right_ = 1.0 / length(across) * across;
    up_ = cross(back_, right_);
    axis_ = convert<double>(fit_camera.up);
    axis_ = 1.0 / length(axis_) * axis_;
    if (fit_camera.projection == Projection::orthographic) {
        cosine_[0] = cosine_[1] = 1.0;
        return;
    }
    const double upward = slope_of_view(fit_camera.field_of_view) / margin;
    const double slopes[2] = {upward * aspect, upward};
    for (int axis = 0; axis < 2; ++axis) {
        cosine_[axis] = 1.0 / std::sqrt(1.0 + slopes[axis] * slopes[axis]);
        sine_[axis] = slopes[axis] * cosine_[axis];
    }
}

void Frame::include(const Vec3d& center, double radius) {
    if (!center_) return include_ring(center, axis_, 0.0, radius);
    const Vec3d from = center - *center_, along = dot(from, axis_) * axis_;
    include_ring(*center_ + along, axis_, length(from - along), radius);
}

void Frame::include_disc(const Vec3d& center, const Vec3d& axis, double radius) {
    if (center_) return include(center, radius);
    include_ring(center, 1.0 / length(axis) * axis, radius, 0.0);
}

void Frame::include_ring(const Vec3d& center, const Vec3d& axis, double ring, double radius) {
    empty_ = false;
    // Extent beyond the centre in a direction of length 1.
    const auto reach = [&](const Vec3d& direction) {
        if (ring == 0.0) return radius;
        const double cosine = dot(axis, direction);
        return radius + ring * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    };
    const double depth = dot(center, back_);
    const Vec3d across[2] = {right_, up_};
    for (int i = 0; i < 2; ++i) {
        const double place = dot(center, across[i]);
        const Vec3d aside = cosine_[i] * across[i], behind = sine_[i] * back_;
        reach_[i].positive = std::max(reach_[i].positive, depth * sine_[i] + reach(behind + aside) +
                                                              place * cosine_[i]);
        reach_[i].negative = std::max(reach_[i].negative, depth * sine_[i] + reach(behind - aside) -
                                                              place * cosine_[i]);
        extent_[i].positive = std::max(extent_[i].positive, place + reach(across[i]));
        extent_[i].negative = std::max(extent_[i].negative, reach(across[i]) - place);
    }
    along_.positive = std::max(along_.positive, depth + reach(back_));
    along_.negative = std::max(along_.negative, reach(back_) - depth);
}

void Frame::include(const Bounds& bounds) {
    if (!is_finite(bounds) || bounds.lower.x > bounds.upper.x) return;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3f point;
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = (corner >> axis & 1) != 0 ? bounds.upper[axis] : bounds.lower[axis];
        include(convert<double>(point), 0.0);
    }
}

Frame Frame::cleared() const {
    Frame frame = *this;
    for (Reach* const reach :
         {&frame.reach_[0], &frame.reach_[1], &frame.along_, &frame.extent_[0], &frame.extent_[1]})
        *reach = {};
    frame.empty_ = true;
    return frame;
}

void Frame::include_common(const Frame& a, const Frame& b) {
    empty_ = false;
    const auto include = [](Reach& to, const Reach& of_a, const Reach& of_b) {
        to.positive = std::max(to.positive, std::min(of_a.positive, of_b.positive));
        to.negative = std::max(to.negative, std::min(of_a.negative, of_b.negative));
    };
    include(along_, a.along_, b.along_);
    for (int i = 0; i < 2; ++i) {
        include(reach_[i], a.reach_[i], b.reach_[i]);
        include(extent_[i], a.extent_[i], b.extent_[i]);
    }
}

Camera Frame::camera() const {
    Camera camera{.projection = fit_camera_.projection,
                  .up = convert<float>(up_),
                  .field_of_view = fit_camera_.field_of_view};
    if (empty_) {
        camera.from = convert<float>(5.0 * back_);
        return camera;
    }
    // The planes at both sides of the image touch its contents. The eye is on both planes.
    const auto zoom = static_cast<double>(fit_camera_.zoom);
    double places[2], depth = along_.positive;
    const double thickness = along_.positive + along_.negative;
    double away = std::abs(along_.positive);
    for (int axis = 0; axis < 2; ++axis) {
        places[axis] = 0.5 * (reach_[axis].positive - reach_[axis].negative) / cosine_[axis];
        away += std::abs(places[axis]);
    }
    // A point has no size, and floats must distinguish the eye from its target.
    const double least = away > 0.0 ? 0x1p-16 * away : 1.0;
    const double size = std::max({thickness, width(), least});
    if (fit_camera_.projection == Projection::orthographic) {
        double height = 0.0;
        for (int axis = 0; axis < 2; ++axis) {
            const double extent = reach_[axis].positive + reach_[axis].negative;
            height = std::max(height, axis == 0 ? extent / aspect_ : extent);
        }
        camera.height = static_cast<float>(margin * std::max(height, least) / zoom);
        depth += size; // anywhere in front of all contents
    } else {
        double eye = -std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 2; ++axis)
            eye =
                std::max(eye, 0.5 * (reach_[axis].positive + reach_[axis].negative) / sine_[axis]);
        // Flat contents seen edge-on must still be in front of the eye.
        depth = std::max(eye, depth + closest * size);
        camera.field_of_view = field_of_view(slope_of_view(fit_camera_.field_of_view) / zoom);
    }
    const Vec3d in_plane = places[0] * right_ + places[1] * up_;
    const double middle = 0.5 * (along_.positive - along_.negative);
    camera.from = convert<float>(in_plane + depth * back_);
    camera.at = convert<float>(in_plane + middle * back_);
    if (camera.at == camera.from) camera.at = convert<float>(in_plane + (depth - size) * back_);
    return camera;
}

double Frame::width() const {
    const auto total = [](const Reach& extent) { return extent.positive + extent.negative; };
    return empty_ ? 0.0 : std::max(total(extent_[0]), total(extent_[1]));
}

std::pair<double, double> Frame::depths(const Camera& camera) const {
    const double eye = dot(convert<double>(camera.from), back_);
    return {eye - along_.positive, eye + along_.negative};
}

} // namespace raylane::core
