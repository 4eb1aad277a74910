#pragma once

#include "core/shapes/form.hpp"
#include "core/shapes/quadratic.hpp"

/// Crossings with a ball about the origin, for spheres and ellipsoids.
namespace raylane::core {

/// Solves |origin + t direction|^2 = radius^2 at the foot of the perpendicular from the centre.
/// Source: Haines, Guenther and Akenine-Moeller, Ray Tracing Gems, ch. 7.
template <class Real>
Crossings<Real> ball_crossings(const Vec3<Real>& origin, const Vec3<Real>& direction,
                               const Real& radius, const Start& start,
                               ErrorPredicate<Real>& predicate) {
    using std::sqrt;
    if (start.on_surface && !start.inward) return {};

    const Real dd = squared_length(direction);
    const Divisor<Real> by_dd(dd);
    const Real tau = -dot(origin, direction) / by_dd;
    if (start.on_surface) return Crossing<Real>{not_behind(Real(tau + tau)), body, false};

    if (predicate.textbook())
        return solve_textbook(dd, Real(dot(origin, direction)),
                              Real(squared_length(origin) - radius * radius));
    const Vec3<Real> foot = mul_add(tau, direction, origin);
    const Real discriminant = mul_add(radius, radius, Real(-squared_length(foot)));
    if (predicate.negative(discriminant)) return {};
    const Real half_chord = sqrt(Real(discriminant / by_dd));
    return {{tau - half_chord, body, true}, {tau + half_chord, body, false}};
}

inline ExactQuadratic ball_along(const Vec3<Dyadic>& origin, const Vec3<Dyadic>& direction,
                                 const Dyadic& radius) {
    return {squared_length(direction), dot(origin, direction),
            squared_length(origin) - radius * radius};
}

/// Returns a number less than 0 inside, 0 on the surface.
template <class Real>
Real ball_at(const Vec3<Real>& point, const Real& radius) {
    return squared_length(point) - radius * radius;
}

} // namespace raylane::core
