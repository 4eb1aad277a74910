#pragma once

#include "core/shapes/checks.hpp"
#include "core/shapes/flat.hpp"
#include "core/shapes/shape.hpp"

namespace raylane::core {

/// The unbounded plane through `point`; its front is where `normal` points.
struct Plane {
    Vec3f point;
    Vec3f normal;

    static constexpr ShapeTraits traits{.bounded = false,
                                        .flat_faces = true,
                                        .meets_again = MeetsAgain::never,
                                        .costs = MethodCosts{1.43, 1.56, 1.0, 2.78}};
};

inline void validate(const Plane& plane) {
    checks::require_point("point", plane.point);
    checks::require_direction("normal", plane.normal);
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

inline ExactQuadratic form_along(const Plane& plane, const ExactRay& ray, Face) {
    return plane_along(convert<Dyadic>(plane.normal), ray.origin - convert<Dyadic>(plane.point),
                       ray.direction);
}

template <class Real>
NormalAlong<Real> normal_along(const Plane& plane, const Ray<Real>&, Face) {
    return {convert<Real>(plane.normal)};
}

} // namespace raylane::core
