#include "core/shapes/bounds.hpp"

#include <cmath>

namespace raylane::core {

namespace {

float rounded_down(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) <= value
               ? nearest
               : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

float rounded_up(double value) {
    return -rounded_down(-value);
}

} // namespace

Bounds WidenedBounds::rounded() const {
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        bounds.lower[axis] = rounded_down(lower_[axis]);
        bounds.upper[axis] = rounded_up(upper_[axis]);
    }
    return bounds;
}

Bounds bounds_around(const Vec3d& center, const Vec3d& extent, const Vec3d& magnitude) {
    WidenedBounds bounds;
    bounds.include(center, extent, magnitude);
    return bounds.rounded();
}

/// Along coordinate i, the extent of a disc is radius * sin(angle between axis and i).
Bounds disc_bounds(const Vec3d& base, const Vec3d& axis, double at, double radius) {
    const Vec3d& a = axis;
    const double length_squared = squared_length(a);
    const Vec3d extent = {radius * std::sqrt((a.y * a.y + a.z * a.z) / length_squared),
                          radius * std::sqrt((a.x * a.x + a.z * a.z) / length_squared),
                          radius * std::sqrt((a.x * a.x + a.y * a.y) / length_squared)};
    return bounds_around(base + at * a, extent, absolute(base) + absolute(at * a));
}

Bounds frustum_bounds(const Vec3d& base, const Vec3d& axis, double base_radius, double top_radius) {
    Bounds bounds = disc_bounds(base, axis, 0.0, base_radius);
    bounds.include(disc_bounds(base, axis, 1.0, top_radius));
    return bounds;
}

} // namespace raylane::core
