#pragma once

#include "core/shapes/checks.hpp"
#include "core/shapes/flat.hpp"
#include "core/shapes/types.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

namespace raylane::core {

void validate(const AnyTriangle auto& t) {
    for (const auto& [name, corner] : {std::pair("a", t.a), {"b", t.b}, {"c", t.c}})
        checks::require_point(name, corner);
    if (checks::are_collinear(t.a, t.b, t.c))
        throw InvalidValue("", "must have three corners that are not collinear, got " +
                                   checks::text_of(t.a) + ", " + checks::text_of(t.b) + ", " +
                                   checks::text_of(t.c));
    if constexpr (requires { t.normal_a; }) {
        checks::require_direction("normals/0", t.normal_a);
        checks::require_direction("normals/1", t.normal_b);
        checks::require_direction("normals/2", t.normal_c);
    }
}

Bounds bounds_of(const AnyTriangle auto& t) {
    Bounds bounds;
    for (const auto& corner : {t.a, t.b, t.c})
        if constexpr (std::is_same_v<decltype(t.a), Vec3f>)
            bounds.include({corner, corner});
        else
            bounds.include(bounds_around(corner, Vec3d(0.0), Vec3d(0.0)));
    return bounds;
}

/// Returns twice the signed areas of the triangles (p, b, c), (p, c, a), (p, a, b) as seen along
/// the ray through p: triple products of the direction and the corners relative to the origin
/// (Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", 2013). They are opposite, to
/// the bit, for the same edge in reverse.
template <class Real>
Vec3<Real> edge_functions(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& c,
                          const Vec3<Real>& direction) {
    return {dot(direction, cross(c, b)), dot(direction, cross(a, c)), dot(direction, cross(b, a))};
}

template <class Real, AnyTriangle Shape>
Crossings<Real> crossings(const Shape& triangle, const Ray<Real>& ray, const Start& start,
                          ErrorPredicate<Real>& predicate) {
    if (start.on_surface) return {};
    const Vec3<Real> a = convert<Real>(triangle.a) - ray.origin;
    const Vec3<Real> b = convert<Real>(triangle.b) - ray.origin;
    const Vec3<Real> c = convert<Real>(triangle.c) - ray.origin;

    // Inside if the ray passes all three edges on the same side, or through an edge.
    const Vec3<Real> areas = edge_functions(a, b, c, ray.direction);
    const int u = predicate.sign(areas.x), v = predicate.sign(areas.y), w = predicate.sign(areas.z);
    const bool some_negative = u < 0 || v < 0 || w < 0;
    const bool some_positive = u > 0 || v > 0 || w > 0;
    if (some_negative == some_positive) return {}; // both: outside; neither: in the plane

    const Vec3<Real> normal = cross(Vec3<Real>(b - a), Vec3<Real>(c - a));
    const auto crossing = cross_plane(a, normal, ray.direction, predicate);
    return crossing ? Crossings<Real>(*crossing) : Crossings<Real>();
}

template <class Real, AnyTriangle Shape>
Vec3<Real> triangle_normal(const Shape& triangle) {
    const Vec3<Real> a = convert<Real>(triangle.a);
    return cross(Vec3<Real>(convert<Real>(triangle.b) - a),
                 Vec3<Real>(convert<Real>(triangle.c) - a));
}

template <class Real, AnyTriangle Shape>
Vec3<Real> outward_direction(const Shape& triangle, const Vec3<Real>&, Face) {
    return triangle_normal<Real>(triangle);
}

/// Returns the number of the first triangle with a corner outside of the plane of all, by more than
/// the rounding of coordinates that have some five digits or are floats: 2^-14 of the distance
/// between corners, and 2^-20 of the coordinates. Without one, returns the count.
template <AnyTriangle Shape>
std::size_t first_off_plane(std::span<const Shape> triangles) {
    const auto normal_of = [](const Shape& triangle) { return triangle_normal<double>(triangle); };
    const Shape& largest =
        *std::max_element(triangles.begin(), triangles.end(), [&](const Shape& a, const Shape& b) {
            return squared_length(normal_of(a)) < squared_length(normal_of(b));
        });
    const Vec3d of_largest = normal_of(largest), center = convert<double>(largest.a);
    Vec3d sum(0.0);
    double size = 0.0, coordinate = 0.0;
    for (const Shape& triangle : triangles) {
        const Vec3d normal = normal_of(triangle);
        sum += dot(normal, of_largest) < 0.0 ? -normal : normal;
        for (const auto& corner : {triangle.a, triangle.b, triangle.c}) {
            size = std::max(size, length(convert<double>(corner) - center));
            coordinate = std::max(coordinate, length(convert<double>(corner)));
        }
    }
    const double most = 0x1p-14 * size + 0x1p-20 * coordinate;
    const auto is_off = [&](const auto& corner) {
        return std::abs(dot(sum, convert<double>(corner) - center)) > most * length(sum);
    };
    std::size_t number = 0;
    while (number < triangles.size() && !is_off(triangles[number].a) &&
           !is_off(triangles[number].b) && !is_off(triangles[number].c))
        ++number;
    return number;
}

/// Returns the corners' normals, weighted by the barycentric coordinates of `point`; the flat
/// normal if they cancel.
template <class Real, class Number>
Vec3<Real> shading_normal(const SmoothTriangleOf<Number>& triangle, const Vec3<Real>& point) {
    const Vec3<Real> flat = triangle_normal<Real>(triangle);
    const Vec3<Real> a = convert<Real>(triangle.a) - point;
    const Vec3<Real> b = convert<Real>(triangle.b) - point;
    const Vec3<Real> c = convert<Real>(triangle.c) - point;
    const Vec3<Real> sum = dot(flat, cross(b, c)) * normalized(convert<Real>(triangle.normal_a)) +
                           dot(flat, cross(c, a)) * normalized(convert<Real>(triangle.normal_b)) +
                           dot(flat, cross(a, b)) * normalized(convert<Real>(triangle.normal_c));
    return squared_length(sum) > Real(0.0) ? normalized(sum) : normalized(flat);
}

ExactQuadratic form_along(const AnyTriangle auto& triangle, const ExactRay& ray, Face) {
    return plane_along(triangle_normal<Dyadic>(triangle), ray.origin - convert<Dyadic>(triangle.a),
                       ray.direction);
}

template <class Real, AnyTriangle Shape>
NormalAlong<Real> normal_along(const Shape& triangle, const Ray<Real>&, Face) {
    return {triangle_normal<Real>(triangle)};
}

} // namespace raylane::core
