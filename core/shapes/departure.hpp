#pragma once

#include "core/shapes/clear_departure.hpp"
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
    const auto per_length = [&](double value) { // squares of tiny normals underflow
        const double largest = largest_component(normal);
        return std::abs(value) / largest / length(normal / largest);
    };
    const auto from_plane = [&](const Vec3d& on_plane) {
        return per_length(dot(normal, point - on_plane));
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
        return per_length(forms_at(shape, point)[0]);
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
