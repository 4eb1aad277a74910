#pragma once

#include "core/shapes/checks.hpp"
#include "core/shapes/flat.hpp"
#include "core/shapes/types.hpp"

namespace raylane::core {

template <class Number>
void validate(const DiscOf<Number>& disc) {
    checks::require_point("center", disc.center);
    checks::require_direction("normal", disc.normal);
    checks::require_positive("radius", disc.radius);
}

template <class Number>
Bounds bounds_of(const DiscOf<Number>& disc) {
    return disc_bounds(convert<double>(disc.center), convert<double>(disc.normal), 0.0,
                       static_cast<double>(disc.radius));
}

template <class Real, class Number>
Crossings<Real> crossings(const DiscOf<Number>& disc, const Ray<Real>& ray, const Start& start,
                          ErrorPredicate<Real>& predicate) {
    if (start.on_surface) return {};
    const Vec3<Real> to_center = convert<Real>(disc.center) - ray.origin;
    const auto crossing =
        cross_plane(to_center, convert<Real>(disc.normal), ray.direction, predicate);
    if (!crossing) return {};
    const Vec3<Real> from_center = mul_add(crossing->t, ray.direction, Vec3<Real>(-to_center));
    const Real radius = Real(disc.radius);
    if (predicate.less(Real(radius * radius), squared_length(from_center))) return {};
    return *crossing;
}

template <class Real, class Number>
Vec3<Real> outward_direction(const DiscOf<Number>& disc, const Vec3<Real>&, Face) {
    return convert<Real>(disc.normal);
}

template <class Number>
ExactQuadratic form_along(const DiscOf<Number>& disc, const ExactRay& ray, Face) {
    return plane_along(convert<Dyadic>(disc.normal), ray.origin - convert<Dyadic>(disc.center),
                       ray.direction);
}

template <class Real, class Number>
NormalAlong<Real> normal_along(const DiscOf<Number>& disc, const Ray<Real>&, Face) {
    return {convert<Real>(disc.normal)};
}

} // namespace raylane::core
