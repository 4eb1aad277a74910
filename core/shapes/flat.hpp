#pragma once

#include "core/shapes/form.hpp"
#include "core/shapes/judge.hpp"
#include "core/shapes/ray.hpp"

#include <optional>

/// Plane, disc and triangle. A ray that starts on a flat surface does not meet it again; one inside
/// its plane does not hit it.
namespace raylane::core {

/// normal . (origin + t direction - point) = 0
template <class Real>
std::optional<Crossing<Real>> cross_plane(const Vec3<Real>& to_point, const Vec3<Real>& normal,
                                          const Vec3<Real>& direction, Judge<Real>& judge) {
    const Real approach = dot(normal, direction);
    const int side = judge.sign(approach);
    if (side == 0) return std::nullopt;
    return Crossing<Real>{dot(normal, to_point) / approach, body, side < 0};
}

template <class Real>
Crossings<Real> crossings(const Plane& plane, const Ray<Real>& ray, const Start& start,
                          Judge<Real>& judge) {
    if (start.on_surface) return {};
    const auto crossing = cross_plane(Vec3<Real>(convert<Real>(plane.point) - ray.origin),
                                      convert<Real>(plane.normal), ray.direction, judge);
    return crossing ? Crossings<Real>(*crossing) : Crossings<Real>();
}

template <class Real>
Vec3<Real> outward_direction(const Plane& plane, const Vec3<Real>&, Face) {
    return convert<Real>(plane.normal);
}

template <class Real>
Crossings<Real> crossings(const Disc& disc, const Ray<Real>& ray, const Start& start,
                          Judge<Real>& judge) {
    if (start.on_surface) return {};
    const Vec3<Real> to_center = convert<Real>(disc.center) - ray.origin;
    const auto crossing = cross_plane(to_center, convert<Real>(disc.normal), ray.direction, judge);
    if (!crossing) return {};
    const Vec3<Real> from_center = mul_add(crossing->t, ray.direction, Vec3<Real>(-to_center));
    const Real radius = Real(disc.radius);
    if (judge.less(Real(radius * radius), squared_length(from_center))) return {};
    return *crossing;
}

template <class Real>
Vec3<Real> outward_direction(const Disc& disc, const Vec3<Real>&, Face) {
    return convert<Real>(disc.normal);
}

/// Twice the signed areas of the triangles (p, b, c), (p, c, a), (p, a, b) as seen along the ray
/// through p: triple products of the direction and the corners relative to the origin (Woop,
/// Benthin and Wald, "Watertight Ray/Triangle Intersection", 2013). They come out opposite, to the
/// bit, for the same edge run backwards.
template <class Real>
Vec3<Real> edge_functions(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& c,
                          const Vec3<Real>& direction) {
    return {dot(direction, cross(c, b)), dot(direction, cross(a, c)), dot(direction, cross(b, a))};
}

template <class Real>
Crossings<Real> cross_triangle(const Vec3f& corner_a, const Vec3f& corner_b, const Vec3f& corner_c,
                               const Ray<Real>& ray, const Start& start, Judge<Real>& judge) {
    if (start.on_surface) return {};
    const Vec3<Real> a = convert<Real>(corner_a) - ray.origin;
    const Vec3<Real> b = convert<Real>(corner_b) - ray.origin;
    const Vec3<Real> c = convert<Real>(corner_c) - ray.origin;

    // Inside if the ray passes all three edges on the same side, or through an edge.
    const Vec3<Real> areas = edge_functions(a, b, c, ray.direction);
    const int u = judge.sign(areas.x), v = judge.sign(areas.y), w = judge.sign(areas.z);
    const bool some_negative = u < 0 || v < 0 || w < 0;
    const bool some_positive = u > 0 || v > 0 || w > 0;
    if (some_negative == some_positive) return {}; // both: outside; neither: in the plane

    const Vec3<Real> normal = cross(Vec3<Real>(b - a), Vec3<Real>(c - a));
    const auto crossing = cross_plane(a, normal, ray.direction, judge);
    return crossing ? Crossings<Real>(*crossing) : Crossings<Real>();
}

template <class Real>
Crossings<Real> crossings(const Triangle& triangle, const Ray<Real>& ray, const Start& start,
                          Judge<Real>& judge) {
    return cross_triangle(triangle.a, triangle.b, triangle.c, ray, start, judge);
}

template <class Real>
Crossings<Real> crossings(const SmoothTriangle& triangle, const Ray<Real>& ray, const Start& start,
                          Judge<Real>& judge) {
    return cross_triangle(triangle.a, triangle.b, triangle.c, ray, start, judge);
}

template <class Real, class AnyTriangle>
Vec3<Real> triangle_normal(const AnyTriangle& triangle) {
    const Vec3<Real> a = convert<Real>(triangle.a);
    return cross(Vec3<Real>(convert<Real>(triangle.b) - a),
                 Vec3<Real>(convert<Real>(triangle.c) - a));
}

template <class Real>
Vec3<Real> outward_direction(const Triangle& triangle, const Vec3<Real>&, Face) {
    return triangle_normal<Real>(triangle);
}

template <class Real>
Vec3<Real> outward_direction(const SmoothTriangle& triangle, const Vec3<Real>&, Face) {
    return triangle_normal<Real>(triangle);
}

/// The corners' normals, weighted by the barycentric coordinates of `point`; the flat normal where
/// they cancel.
template <class Real>
Vec3<Real> shading_normal(const SmoothTriangle& triangle, const Vec3<Real>& point) {
    const Vec3<Real> flat = triangle_normal<Real>(triangle);
    const Vec3<Real> a = convert<Real>(triangle.a) - point;
    const Vec3<Real> b = convert<Real>(triangle.b) - point;
    const Vec3<Real> c = convert<Real>(triangle.c) - point;
    const Vec3<Real> sum = dot(flat, cross(b, c)) * normalized(convert<Real>(triangle.normal_a)) +
                           dot(flat, cross(c, a)) * normalized(convert<Real>(triangle.normal_b)) +
                           dot(flat, cross(a, b)) * normalized(convert<Real>(triangle.normal_c));
    return squared_length(sum) > Real(0.0) ? normalized(sum) : normalized(flat);
}

template <class Real>
NormalAlong<Real> normal_along(const Plane& plane, const Ray<Real>&, Face) {
    return {convert<Real>(plane.normal)};
}

inline ExactQuadratic form_along(const Plane& plane, const ExactRay& ray, Face) {
    return plane_along(convert<Dyadic>(plane.normal), ray.origin - convert<Dyadic>(plane.point),
                       ray.direction);
}

template <class Real>
NormalAlong<Real> normal_along(const Disc& disc, const Ray<Real>&, Face) {
    return {convert<Real>(disc.normal)};
}

inline ExactQuadratic form_along(const Disc& disc, const ExactRay& ray, Face) {
    return plane_along(convert<Dyadic>(disc.normal), ray.origin - convert<Dyadic>(disc.center),
                       ray.direction);
}

template <class Real>
NormalAlong<Real> normal_along(const Triangle& triangle, const Ray<Real>&, Face) {
    return {triangle_normal<Real>(triangle)};
}

inline ExactQuadratic form_along(const Triangle& triangle, const ExactRay& ray, Face) {
    return plane_along(triangle_normal<Dyadic>(triangle), ray.origin - convert<Dyadic>(triangle.a),
                       ray.direction);
}

inline Triangle flat(const SmoothTriangle& triangle) {
    return {triangle.a, triangle.b, triangle.c};
}

template <class Real>
NormalAlong<Real> normal_along(const SmoothTriangle& triangle, const Ray<Real>& ray, Face face) {
    return normal_along(flat(triangle), ray, face);
}

inline ExactQuadratic form_along(const SmoothTriangle& triangle, const ExactRay& ray, Face face) {
    return form_along(flat(triangle), ray, face);
}

} // namespace raylane::core
