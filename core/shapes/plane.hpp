#pragma once

#include "core/shapes/checks.hpp"
#include "core/shapes/flat.hpp"
#include "core/shapes/types.hpp"

#include <array>

namespace raylane::core {

template <class Number>
void validate(const PlaneOf<Number>& plane) {
    checks::require_point("point", plane.point);
    checks::require_direction("normal", plane.normal);
}

template <class Real, class Number>
Crossings<Real> crossings(const PlaneOf<Number>& plane, const Ray<Real>& ray, const Start& start,
                          ErrorPredicate<Real>& predicate) {
    if (start.on_surface) return {};
    const auto crossing = cross_plane(Vec3<Real>(convert<Real>(plane.point) - ray.origin),
                                      convert<Real>(plane.normal), ray.direction, predicate);
    return crossing ? Crossings<Real>(*crossing) : Crossings<Real>();
}

template <class Real, class Number>
Vec3<Real> outward_direction(const PlaneOf<Number>& plane, const Vec3<Real>&, Face) {
    return convert<Real>(plane.normal);
}

template <class Number>
ExactQuadratic form_along(const PlaneOf<Number>& plane, const ExactRay& ray, Face) {
    return plane_along(convert<Dyadic>(plane.normal), ray.origin - convert<Dyadic>(plane.point),
                       ray.direction);
}

template <class Real, class Number>
NormalAlong<Real> normal_along(const PlaneOf<Number>& plane, const Ray<Real>&, Face) {
    return {convert<Real>(plane.normal)};
}

/// Returns the form of the half-space behind the plane.
template <class Real, class Number>
std::array<Real, 1> forms_at(const PlaneOf<Number>& plane, const Vec3<Real>& point) {
    return {dot(convert<Real>(plane.normal), Vec3<Real>(point - convert<Real>(plane.point)))};
}

} // namespace raylane::core
