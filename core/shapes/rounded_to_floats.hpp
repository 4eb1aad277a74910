#pragma once

#include "core/shapes/types.hpp"

#include <algorithm>
#include <cmath>

/// What becomes of a shape whose numbers are rounded to float, as filters have them.
namespace raylane::core {

namespace detail {

/// |v - float(v)| of all numbers together: no less than the length that a vector changes by.
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

/// The angle that a direction turns by, or more.
inline double turn_of(const Vec3d& direction) {
    return 1.25 * change_of(direction) / length(direction);
}

} // namespace detail

/// Change: there is a continuous map of a shape's surface onto that of the nearest floats, and
/// back, that moves no point further than this. What a ray in double crosses at t, the ray beside
/// it that is moved by so much crosses at the same t in floats; so filters that grant a ray's
/// origin as much bound the crossings of the shape that is meant. (If all such rays surely cross
/// the floats' surface, and continuously, then by Brouwer's theorem one of them does where its
/// displacement is that of the map: there the ray crosses what is meant.)
///
/// Of planes it is that of their point, of quadrics that of the centre and the box: filters grant
/// what normals and coefficients are off by relative to themselves.
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
