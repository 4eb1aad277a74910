#include "core/shapes/bounds.hpp"

#include <cmath>

namespace raylane::core {

namespace {

/// Twice what a handful of operations in double may be off by, relative to their largest operand.
constexpr double slack = 0x1p-48;

float rounded_down(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) <= value
               ? nearest
               : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

float rounded_up(double value) {
    return -rounded_down(-value);
}

/// [center - extent, center + extent], given both up to rounding in double.
Bounds around(const Vec3d& center, const Vec3d& extent, const Vec3d& magnitude) {
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const double reach = extent[axis] + slack * (extent[axis] + magnitude[axis]);
        bounds.lower[axis] = rounded_down(center[axis] - reach);
        bounds.upper[axis] = rounded_up(center[axis] + reach);
    }
    return bounds;
}

Vec3d absolute(const Vec3d& v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// The disc about base + at * axis, at right angles to the axis: along coordinate i it reaches
/// radius * sin(angle between axis and i).
Bounds disc_bounds(const Vec3f& base, const Vec3f& axis, double at, double radius) {
    const Vec3d b = convert<double>(base), a = convert<double>(axis);
    const double length_squared = squared_length(a);
    const Vec3d extent = {radius * std::sqrt((a.y * a.y + a.z * a.z) / length_squared),
                          radius * std::sqrt((a.x * a.x + a.z * a.z) / length_squared),
                          radius * std::sqrt((a.x * a.x + a.y * a.y) / length_squared)};
    return around(b + at * a, extent, absolute(b) + absolute(at * a));
}

Bounds frustum_bounds(const Vec3f& base, const Vec3f& axis, double base_radius, double top_radius) {
    Bounds bounds = disc_bounds(base, axis, 0.0, base_radius);
    bounds.include(disc_bounds(base, axis, 1.0, top_radius));
    return bounds;
}

Bounds corner_bounds(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    Bounds bounds{a, a};
    bounds.include({b, b});
    bounds.include({c, c});
    return bounds;
}

} // namespace

/// In float, as there may be millions: a sum is off by half an ulp, or exact where it underflows,
/// and 2^-23 of it is an ulp at least.
Bounds bounds_of(const Sphere& sphere) {
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const float lower = sphere.center[axis] - sphere.radius;
        const float upper = sphere.center[axis] + sphere.radius;
        bounds.lower[axis] = lower - 0x1p-23F * std::abs(lower);
        bounds.upper[axis] = upper + 0x1p-23F * std::abs(upper);
    }
    return bounds;
}

Bounds bounds_of(const Disc& disc) {
    return disc_bounds(disc.center, disc.normal, 0.0, static_cast<double>(disc.radius));
}

Bounds bounds_of(const Triangle& triangle) {
    return corner_bounds(triangle.a, triangle.b, triangle.c);
}

Bounds bounds_of(const SmoothTriangle& triangle) {
    return corner_bounds(triangle.a, triangle.b, triangle.c);
}

Bounds bounds_of(const Box& box) {
    const Vec3d half_u = 0.5 * convert<double>(box.edge_u);
    const Vec3d half_v = 0.5 * convert<double>(box.edge_v);
    const Vec3d half_w = 0.5 * convert<double>(box.edge_w);
    const Vec3d corner = convert<double>(box.corner);
    const Vec3d extent = absolute(half_u) + absolute(half_v) + absolute(half_w);
    return around(corner + half_u + half_v + half_w, extent, absolute(corner) + extent);
}

Bounds bounds_of(const OpenCylinder& cylinder) {
    const auto radius = static_cast<double>(cylinder.radius);
    return frustum_bounds(cylinder.base, cylinder.axis, radius, radius);
}

Bounds bounds_of(const CappedCylinder& cylinder) {
    return bounds_of(OpenCylinder{cylinder.base, cylinder.axis, cylinder.radius});
}

Bounds bounds_of(const OpenCone& cone) {
    return frustum_bounds(cone.base, cone.axis, static_cast<double>(cone.base_radius),
                          static_cast<double>(cone.top_radius));
}

Bounds bounds_of(const CappedCone& cone) {
    return bounds_of(OpenCone{cone.base, cone.axis, cone.base_radius, cone.top_radius});
}

Bounds bounds_of(const Quadric& quadric) {
    const Vec3d lower = convert<double>(quadric.lower), upper = convert<double>(quadric.upper);
    const Vec3d center = convert<double>(quadric.center);
    return around(center + 0.5 * (lower + upper), 0.5 * (upper - lower),
                  absolute(center) + absolute(lower) + absolute(upper));
}

} // namespace raylane::core
