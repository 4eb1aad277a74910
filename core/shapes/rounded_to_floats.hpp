#pragma once

#include "core/shapes/types.hpp"

#include <algorithm>
#include <cmath>

/// Bounds on the change of a shape whose numbers are rounded to float, as filters see it.
namespace raylane::core {

namespace detail {

/// Returns the sum of |v - float(v)| over all numbers: an upper bound on the change of a vector.
template <class... Values>
double change_of(const Values&... values) {
    const auto of_number = [](double x) {
        return std::abs(x - static_cast<double>(static_cast<float>(x)));
    };
    const auto of_one = [&](const auto& value) {
        if constexpr (requires { value.x; })
            return of_number(value.x) + of_number(value.y) + of_number(value.z);
        else
            return of_number(value);
    };
    return (of_one(values) + ...);
}

/// Returns an upper bound on the angle by which a direction turns.
inline double turn_of(const Vec3d& direction) {
    return 1.25 * change_of(direction) / length(direction);
}

} // namespace detail

/// Returns the change of a shape: a distance such that a continuous map of its surface onto that of
/// the nearest floats, and one back, move no point further than this. If a ray crosses the exact
/// surface at t, the parallel ray displaced by the map crosses the float surface at the same t.
/// Filters that allow a ray's origin this displacement therefore bound the crossings of the exact
/// shape. (Suppose that all rays with such a displacement certainly cross the float surface, at a
/// point that depends on the displacement continuously. Then, by Brouwer's theorem, one of them
/// crosses it where its displacement equals that of the map: there the ray crosses the exact
/// surface.)
///
/// For planes, this is the change of their point; for quadrics, that of the centre and the box.
/// Filters allow for the relative error of normals and coefficients themselves.
inline double change_in_floats(const InDouble<Sphere>& s) {
    return detail::change_of(s.center, s.radius);
}
inline double change_in_floats(const InDouble<Plane>& plane) {
    return detail::change_of(plane.point);
}
inline double change_in_floats(const InDouble<Disc>& disc) {
    return detail::change_of(disc.center, disc.radius) + disc.radius * detail::turn_of(disc.normal);
}
double change_in_floats(const AnyTriangle auto& t) {
    return detail::change_of(t.a, t.b, t.c);
}
inline double change_in_floats(const InDouble<Box>& box) {
    return detail::change_of(box.corner, box.edge_u, box.edge_v, box.edge_w);
}
template <Ends ends>
double change_in_floats(const CylinderOf<double, ends>& c) {
    return detail::change_of(c.base, c.axis, c.radius) + c.radius * detail::turn_of(c.axis);
}
template <Ends ends>
double change_in_floats(const ConeOf<double, ends>& c) {
    return detail::change_of(c.base, c.axis, c.base_radius, c.top_radius) +
           std::max(c.base_radius, c.top_radius) * detail::turn_of(c.axis);
}
inline double change_in_floats(const InDouble<Quadric>& q) {
    return detail::change_of(q.center, q.lower, q.upper);
}
inline double change_in_floats(const InDouble<Ellipsoid>& e) {
    return detail::change_of(e.center, e.axis_u, e.axis_v, e.axis_w);
}

} // namespace raylane::core
