#pragma once

#include "core/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

/// Rays that start on a shape: the side to which they go, and checks of the starts that callers
/// give.
namespace raylane::core {

/// Returns the number of a shape's faces: see Face.
template <class Shape>
constexpr int face_count() {
    constexpr Kind kind = kind_of<Shape>;
    return kind == Kind::box                                            ? 6
           : kind == Kind::capped_cylinder || kind == Kind::capped_cone ? 3
                                                                        : 1;
}

namespace detail {

/// Returns about the distance of a point from the surface with a face. `normal`: the surface's
/// outward_direction() there.
template <class Shape>
double distance_from(const Shape& shape, const Vec3d& point, Face face, const Vec3d& normal) {
    constexpr Kind kind = kind_of<Shape>;
    const auto from_plane = [&](const Vec3d& on_plane) {
        return std::abs(dot(normal, point - on_plane)) / length(normal);
    };
    if constexpr (kind == Kind::box) {
        const Vec3d edges[] = {shape.edge_u, shape.edge_v, shape.edge_w};
        return from_plane(face % 2 == 0 ? shape.corner : shape.corner + edges[face / 2]);
    } else if constexpr (kind == Kind::disc) {
        return from_plane(shape.center);
    } else if constexpr (AnyTriangle<Shape>) {
        return from_plane(shape.a);
    } else if constexpr (requires { shape.axis; }) {
        if (face != body)
            return from_plane(face == base_cap ? shape.base : shape.base + shape.axis);
        const double share = dot(point - shape.base, shape.axis) / squared_length(shape.axis);
        double radius = 0.0;
        if constexpr (requires { shape.radius; })
            radius = shape.radius;
        else
            radius = shape.base_radius + share * (shape.top_radius - shape.base_radius);
        return std::abs(length(offset_from_axis(shape.base, shape.axis, point)) - radius);
    } else {
        // The form's gradient is once or twice the normal.
        return std::abs(forms_at(shape, point)[0]) / length(normal);
    }
}

/// Returns how far the origin of a ray may be from the point for which it stands: a share of the
/// shape's size, and 2^-18 of all coordinates.
template <class Shape>
double tolerance_of(const Shape& shape, const Vec3d& origin, double share_of_size) {
    double size = 0.0, coordinate = largest_component(origin);
    if constexpr (is_bounded<Shape>) {
        const Bounds bounds = bounds_of(shape);
        for (int axis = 0; axis < 3; ++axis) {
            const auto lower = static_cast<double>(bounds.lower[axis]);
            const auto upper = static_cast<double>(bounds.upper[axis]);
            size = std::max(size, upper - lower);
            coordinate = std::max({coordinate, std::abs(lower), std::abs(upper)});
        }
    }
    return share_of_size * size + 0x1p-18 * coordinate;
}

inline std::optional<int> sign_of(const Bounded<double>& number) {
    if (!(number.magnitude() > number.error)) return {};
    return number.value > 0.0 ? 1 : -1;
}
inline std::optional<int> sign_of(const Dyadic& number) {
    return number.sign();
}

/// Returns the side of a ray from the apex of a cone, or nothing if errors leave it open: the cone
/// is around the ray if the ray goes towards the base, and faster so than it goes away from the
/// axis.
template <class Shape, class Real>
std::optional<int> side_from_apex(const Shape& cone, const ScaledAxialRay<Real>& axial,
                                  const ScaledWidth<Real>& width) {
    const std::optional<int> along = sign_of(dot(apex_direction<Real>(cone), axial.direction));
    if (!along) return {};
    if (*along >= 0) return 1;
    const Real across = axial.axis_squared * squared_length(axial.direction) -
                        axial.height_direction * axial.height_direction;
    return sign_of(axial.axis_squared * across - width.direction * width.direction);
}

/// Returns side_of_departure(), or nothing if the errors of these numbers leave it open.
template <class Real, class Shape>
std::optional<int> side_in(const Shape& shape, const Ray<double>& given, Face face) {
    const Ray<Real> ray{convert<Real>(given.origin), convert<Real>(given.direction)};
    if constexpr (kind_of<Shape> == Kind::box && !std::is_same_v<Real, Dyadic>)
        return sign_of(dot(outward_direction(shape, ray.origin, face), ray.direction)); // faster
    if constexpr (requires { shape.base_radius; }) {
        // At the apex the normal is 0. Beyond it, where rounding may have moved the origin, the
        // normal of the cone's form points to the inside.
        const ScaledAxialRay<Real> axial(shape.base, shape.axis, ray);
        const ScaledWidth<Real> width(shape.base_radius, shape.top_radius, axial);
        const std::optional<int> before_apex = face == body ? sign_of(width.origin) : 1;
        if (!before_apex) return {};
        if (*before_apex <= 0) return side_from_apex(shape, axial, width);
    }
    return sign_of(dot(normal_along(shape, ray, face).v, ray.direction));
}

} // namespace detail

/// Returns true if the origin of a ray that leaves a face may be a point of it that was rounded,
/// also in float and from far away. Any point may be on an unbounded shape.
template <class Shape>
bool may_start_on(const Shape& shape, const Vec3d& origin, Face face, double share_of_size) {
    if constexpr (is_bounded<Shape>) {
        const double most = detail::tolerance_of(shape, origin, share_of_size);
        const Bounds bounds = bounds_of(shape);
        for (int axis = 0; axis < 3; ++axis)
            if (!(origin[axis] >= static_cast<double>(bounds.lower[axis]) - most &&
                  origin[axis] <= static_cast<double>(bounds.upper[axis]) + most))
                return false;
        // Not a number at an apex, where the normal vanishes.
        return !(detail::distance_from(shape, origin, face,
                                       outward_direction(shape, origin, face)) > most);
    } else {
        return true;
    }
}

/// Returns the side of a face to which a ray goes that starts on it, as real arithmetic decides for
/// the normal at its origin: -1 inside (behind), 1 outside, 0 along the surface. From the apex of
/// a cone and from beyond it, the side is that of a ray from the apex.
template <class Shape>
int side_of_departure(const Shape& shape, const Ray<double>& ray, Face face) {
    const std::optional<int> side = detail::side_in<Bounded<double>>(shape, ray, face);
    return side ? *side : *detail::side_in<Dyadic>(shape, ray, face);
}

/// Returns side_of_departure() of a ray that may_start_on() a shape, if both are decided by few
/// operations, as for most rays from spheres and from the sides of cylinders and cones. Otherwise
/// returns 0. Uses no FMA: processors without it would call a function for each.
template <class Shape>
int clear_side_of_departure(const Shape& shape, const Ray<double>& ray, Face face,
                            double share_of_size) {
    constexpr Kind kind = kind_of<Shape>;
    if constexpr (kind == Kind::sphere || requires { shape.axis; }) {
        const auto product = [](const Vec3d& a, const Vec3d& b) {
            return a.x * b.x + a.y * b.y + a.z * b.z;
        };
        const auto sizes = [](const Vec3d& a, const Vec3d& b) {
            return std::abs(a.x * b.x) + std::abs(a.y * b.y) + std::abs(a.z * b.z);
        };
        const Vec3d& d = ray.direction;
        Vec3d normal, offset; // offset: from the centre or the axis
        double size = 0.0;    // that of the terms of dot(normal, d)
        double radius = 0.0;
        if constexpr (kind == Kind::sphere) {
            offset = normal = ray.origin - convert<double>(shape.center);
            size = sizes(normal, d);
            radius = static_cast<double>(shape.radius);
        } else {
            const Vec3d axis = convert<double>(shape.axis);
            const Vec3d from_base = ray.origin - convert<double>(shape.base);
            const double axis_squared = product(axis, axis);
            const double height = product(from_base, axis) / axis_squared;
            if (face != body || !(height >= 0.0 && height <= 1.0)) return 0;
            const double height_size = sizes(from_base, axis) / axis_squared;
            offset = normal = from_base - height * axis;
            size = sizes(from_base, d) + height_size * sizes(axis, d);
            if constexpr (requires { shape.radius; }) {
                radius = static_cast<double>(shape.radius);
            } else {
                const auto base_radius = static_cast<double>(shape.base_radius);
                const double growth = static_cast<double>(shape.top_radius) - base_radius;
                const double slope = growth / axis_squared;
                radius = base_radius + height * growth;
                normal = offset - radius * slope * axis;
                size += (base_radius + height_size * std::abs(growth)) * std::abs(slope) *
                        sizes(axis, d);
            }
        }
        if (!(std::abs(product(offset, offset) - radius * radius) <=
              share_of_size * (radius * radius)))
            return 0;
        // At most 40 roundings, each by 2^-53 of `size`. Underflow is far below that.
        const double along = product(normal, d);
        const double most = largest_component(d);
        if (most > 0x1p-300 && most < 0x1p400 && size > 0x1p-600 * most &&
            std::abs(along) > 0x1p-45 * size)
            return along > 0.0 ? 1 : -1;
    }
    return 0;
}

/// Returns the side of a face to which a ray goes at an angle that rounding of its origin does not
/// explain: -1 inside, 1 outside, 0 if rounding does. Near a tip, or on a tiny shape, the normal is
/// another one just beside the origin.
template <class Shape>
int certain_side(const Shape& shape, const Ray<double>& ray, Face face, double share_of_size) {
    const Vec3d along = ray.direction / largest_component(ray.direction);
    const auto sine_at = [&](const Vec3d& point) {
        const Vec3d normal = outward_direction(shape, point, face);
        return dot(normal, along) / (length(normal) * length(along));
    };
    const double off = detail::tolerance_of(shape, ray.origin, share_of_size);
    const double sine = sine_at(ray.origin), least = 2.0 * share_of_size;
    bool is_clear = std::abs(sine) > least; // false for NaN, as at an apex
    for (int axis = 0; axis < 3; ++axis)
        for (const double step : {-off, off}) {
            Vec3d beside = ray.origin;
            beside[axis] += step;
            is_clear = is_clear && std::copysign(1.0, sine) * sine_at(beside) > least;
        }
    return !is_clear ? 0 : sine > 0.0 ? 1 : -1;
}

} // namespace raylane::core
