#pragma once

#include "core/shapes/checks.hpp"
#include "core/shapes/flat.hpp"
#include "core/shapes/shape.hpp"

namespace raylane::core {

struct Disc {
    Vec3f center;
    Vec3f normal;
    float radius; ///< > 0

    static constexpr ShapeTraits traits{.bounded = true,
                                        .flat_faces = true,
                                        .meets_again = MeetsAgain::never,
                                        .costs = MethodCosts{1.07, 1.18, 1.0, 2.15}};
};

inline void validate(const Disc& disc) {
    checks::require_point("center", disc.center);
    checks::require_direction("normal", disc.normal);
    checks::require_positive("radius", disc.radius);
}

inline Bounds bounds_of(const Disc& disc) {
    return disc_bounds(disc.center, disc.normal, 0.0, static_cast<double>(disc.radius));
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

inline ExactQuadratic form_along(const Disc& disc, const ExactRay& ray, Face) {
    return plane_along(convert<Dyadic>(disc.normal), ray.origin - convert<Dyadic>(disc.center),
                       ray.direction);
}

template <class Real>
NormalAlong<Real> normal_along(const Disc& disc, const Ray<Real>&, Face) {
    return {convert<Real>(disc.normal)};
}

} // namespace raylane::core
