#pragma once

#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>

/// Departures of rays that few operations decide: see departure.hpp. Uses no FMA: processors
/// without it would call a function for each.
namespace raylane::core {

namespace detail {

/// A vector computed by few operations, and for each component the sum of the sizes of its terms.
/// A component errs by 2^-53 of this sum for each rounding.
struct SizedVector {
    Vec3d value, size;
};

inline double product(const Vec3d& a, const Vec3d& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double product_size(const Vec3d& a, const Vec3d& b) {
    return std::abs(a.x * b.x) + std::abs(a.y * b.y) + std::abs(a.z * b.z);
}
inline SizedVector sized(const Vec3d& a) {
    return {a, absolute(a)};
}
inline SizedVector sized_cross(const Vec3d& a, const Vec3d& b) {
    const Vec3d first(a.y * b.z, a.z * b.x, a.x * b.y), second(a.z * b.y, a.x * b.z, a.y * b.x);
    return {first - second, absolute(first) + absolute(second)};
}

/// Returns the side of a normal to which a direction goes if it is clear, otherwise 0. The normal
/// comes from at most 36 roundings. Underflow is far below the errors of these.
inline int clear_side(const SizedVector& normal, const Vec3d& direction) {
    const double along = product(normal.value, direction);
    const double size = product_size(normal.size, direction);
    const double most = largest_component(direction);
    if (most > 0x1p-300 && most < 0x1p400 && size > 0x1p-600 * most &&
        std::abs(along) > 0x1p-45 * size)
        return along > 0.0 ? 1 : -1;
    return 0;
}

/// Returns true if an offset from a point of a plane is off the plane by at most `most`, which is
/// at least 2^-12 of its length. False for a normal of which rounding leaves few digits.
inline bool is_near_plane(const SizedVector& normal, const Vec3d& offset, double most) {
    const double squared = product(normal.value, normal.value);
    const double height = product(normal.value, offset);
    return squared > 0x1p-900 && squared < 0x1p1000 &&
           squared > 0x1p-50 * product(normal.size, normal.size) &&
           height * height <= most * most * squared;
}

/// Returns the side to which a ray goes from a disc, if it starts on it within half of what
/// may_start_on() allows: a disc's bounds have a side of at least 1.6 radii.
inline int clear_side_of_disc(const Vec3d& center, const Vec3d& normal, double radius,
                              const Ray<double>& ray, double share) {
    const Vec3d offset = ray.origin - center;
    const bool is_inside = product(offset, offset) <= (1.0 + 0.5 * share) * (radius * radius);
    return is_inside && is_near_plane(sized(normal), offset, 0.5 * share * radius)
               ? clear_side(sized(normal), ray.direction)
               : 0;
}

/// The box around points.
struct Extent {
    Vec3d lower, upper;
    void include(const Vec3d& point) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], point[axis]);
            upper[axis] = std::max(upper[axis], point[axis]);
        }
    }
    void extend(const Vec3d& by) {
        for (int axis = 0; axis < 3; ++axis)
            (by[axis] < 0.0 ? lower : upper)[axis] += by[axis];
    }
};

/// Returns the same for a face of a shape, of which a point is given.
inline int clear_side_of_face(const Extent& shape, const Vec3d& point, const SizedVector& normal,
                              const Ray<double>& ray, double share) {
    const double most = 0.5 * share * largest_component(Vec3d(shape.upper - shape.lower));
    for (int axis = 0; axis < 3; ++axis)
        if (!(ray.origin[axis] >= shape.lower[axis] - most &&
              ray.origin[axis] <= shape.upper[axis] + most))
            return 0;
    return is_near_plane(normal, ray.origin - point, most) ? clear_side(normal, ray.direction) : 0;
}

/// Returns the same for a sphere.
inline int clear_side_of_ball(const Vec3d& offset, double radius, const Ray<double>& ray,
                              double share) {
    return std::abs(product(offset, offset) - radius * radius) <= share * (radius * radius)
               ? clear_side({offset, absolute(offset)}, ray.direction)
               : 0;
}

/// Returns the same for the side of a cylinder or cone.
template <class Shape>
int clear_side_of_body(const Shape& shape, const Ray<double>& ray, double share) {
    const Vec3d axis = convert<double>(shape.axis);
    const Vec3d from_base = ray.origin - convert<double>(shape.base);
    const double axis_squared = product(axis, axis);
    const double height = product(from_base, axis) / axis_squared;
    if (!(height >= 0.0 && height <= 1.0)) return 0;
    const double height_size = product_size(from_base, axis) / axis_squared;
    const Vec3d offset = from_base - height * axis;
    SizedVector normal{offset, absolute(from_base) + height_size * absolute(axis)};
    double radius = 0.0;
    if constexpr (requires { shape.radius; }) {
        radius = static_cast<double>(shape.radius);
    } else {
        const auto base_radius = static_cast<double>(shape.base_radius);
        const double growth = static_cast<double>(shape.top_radius) - base_radius;
        const double slope = growth / axis_squared;
        radius = base_radius + height * growth;
        // Other rules apply at the apex, where the true radius is 0.
        if (!(radius > 0x1p-45 * (base_radius + height_size * std::abs(growth)))) return 0;
        normal.value = offset - radius * slope * axis;
        normal.size +=
            (base_radius + height_size * std::abs(growth)) * std::abs(slope) * absolute(axis);
    }
    const double radius_squared = radius * radius;
    const bool is_near =
        radius_squared > 0x1p-900 &&
        std::abs(product(offset, offset) - radius_squared) <= share * radius_squared;
    return is_near ? clear_side(normal, ray.direction) : 0;
}

/// With m = to_ball(p) of ToBall, a start is near if |m|^2 is off by half a share of the squared
/// radius. Then its distance is at most a quarter of the share of its offset from the centre.
template <class Number>
int clear_side_of_ellipsoid(const EllipsoidOf<Number>& ellipsoid, const Ray<double>& ray,
                            double share) {
    const Vec3d u = convert<double>(ellipsoid.axis_u), v = convert<double>(ellipsoid.axis_v),
                w = convert<double>(ellipsoid.axis_w);
    const SizedVector rows[] = {sized_cross(v, w), sized_cross(w, u), sized_cross(u, v)};
    const double radius = std::abs(product(rows[0].value, u));
    const Vec3d offset = ray.origin - convert<double>(ellipsoid.center);
    double squared = 0.0, largest = product_size(rows[0].size, u);
    SizedVector normal{Vec3d(0.0), Vec3d(0.0)};
    for (const SizedVector& row : rows) {
        const double in_ball = product(row.value, offset);
        const double size = product_size(row.size, offset);
        squared += in_ball * in_ball;
        largest = std::max(largest, size);
        normal.value += in_ball * row.value;
        normal.size += size * row.size;
    }
    const double radius_squared = radius * radius;
    const bool is_near = largest <= 0x1p20 * radius && radius_squared > 0x1p-900 &&
                         std::abs(squared - radius_squared) <= 0.5 * share * radius_squared;
    return is_near ? clear_side(normal, ray.direction) : 0;
}

/// Returns the same for a box, and below for a triangle.
template <class Number>
int clear_side_of_box(const BoxOf<Number>& box, const Ray<double>& ray, Face face, double share) {
    const Vec3d edges[] = {convert<double>(box.edge_u), convert<double>(box.edge_v),
                           convert<double>(box.edge_w)};
    const int across = face / 2;
    const bool through_corner = face % 2 == 0;
    SizedVector normal = sized_cross(edges[(across + 1) % 3], edges[(across + 2) % 3]);
    const double volume = product(normal.value, edges[across]);
    if (!(std::abs(volume) > 0x1p-45 * product_size(normal.size, edges[across]))) return 0;
    if ((volume < 0.0) != through_corner) normal.value = -normal.value;
    const Vec3d corner = convert<double>(box.corner);
    Extent extent{corner, corner};
    for (const Vec3d& edge : edges)
        extent.extend(edge);
    return clear_side_of_face(extent, through_corner ? corner : corner + edges[across], normal, ray,
                              share);
}

template <AnyTriangle Shape>
int clear_side_of_triangle(const Shape& triangle, const Ray<double>& ray, double share) {
    const Vec3d a = convert<double>(triangle.a), b = convert<double>(triangle.b),
                c = convert<double>(triangle.c);
    Extent extent{a, a};
    extent.include(b);
    extent.include(c);
    return clear_side_of_face(extent, a, sized_cross(b - a, c - a), ray, share);
}

} // namespace detail

/// Returns side_of_departure() of a ray that may_start_on() a shape, if both are decided by few
/// operations, as for most rays. Otherwise, and for all quadrics, returns 0.
template <class Shape>
int clear_side_of_departure(const Shape& shape, const Ray<double>& ray, Face face, double share) {
    constexpr Kind kind = kind_of<Shape>;
    if constexpr (kind == Kind::sphere) {
        return detail::clear_side_of_ball(ray.origin - convert<double>(shape.center),
                                          static_cast<double>(shape.radius), ray, share);
    } else if constexpr (requires { shape.axis; }) {
        if (face == body) return detail::clear_side_of_body(shape, ray, share);
        const Vec3d base = convert<double>(shape.base), axis = convert<double>(shape.axis);
        double radius = 0.0;
        if constexpr (requires { shape.radius; })
            radius = static_cast<double>(shape.radius);
        else
            radius = static_cast<double>(face == base_cap ? shape.base_radius : shape.top_radius);
        return face == base_cap ? detail::clear_side_of_disc(base, -axis, radius, ray, share)
                                : detail::clear_side_of_disc(base + axis, axis, radius, ray, share);
    } else if constexpr (kind == Kind::ellipsoid) {
        return detail::clear_side_of_ellipsoid(shape, ray, share);
    } else if constexpr (kind == Kind::box) {
        return detail::clear_side_of_box(shape, ray, face, share);
    } else if constexpr (kind == Kind::disc) {
        return detail::clear_side_of_disc(convert<double>(shape.center),
                                          convert<double>(shape.normal),
                                          static_cast<double>(shape.radius), ray, share);
    } else if constexpr (AnyTriangle<Shape>) {
        return detail::clear_side_of_triangle(shape, ray, share);
    } else if constexpr (kind == Kind::plane) {
        return detail::clear_side(detail::sized(convert<double>(shape.normal)), ray.direction);
    } else {
        return 0;
    }
}

} // namespace raylane::core
