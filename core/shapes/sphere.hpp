#pragma once

#include "core/shapes/checks.hpp"
#include "core/shapes/form.hpp"
#include "core/shapes/quadratic.hpp"
#include "core/shapes/shape.hpp"

namespace raylane::core {

struct Sphere {
    Vec3f center;
    float radius; ///< > 0

    static constexpr ShapeTraits traits{.meets_again = MeetsAgain::inward,
                                        .costs = {2.29, 1.70, 1.0, 3.37}};
};

inline void validate(const Sphere& sphere) {
    checks::require_point("center", sphere.center);
    checks::require_positive("radius", sphere.radius);
}

/// In float, as there may be millions: a sum is off by half an ulp, or exact where it underflows,
/// and 2^-23 of it is an ulp at least.
inline Bounds bounds_of(const Sphere& sphere) {
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const float lower = sphere.center[axis] - sphere.radius;
        const float upper = sphere.center[axis] + sphere.radius;
        bounds.lower[axis] = lower - 0x1p-23F * std::abs(lower);
        bounds.upper[axis] = upper + 0x1p-23F * std::abs(upper);
    }
    return bounds;
}

/// |origin + t direction - center|^2 = radius^2, solved at the foot of the perpendicular from the
/// centre. Source: Haines, Guenther and Akenine-Moeller, Ray Tracing Gems, ch. 7.
template <class Real>
Crossings<Real> crossings(const Sphere& sphere, const Ray<Real>& ray, const Start& start,
                          Judge<Real>& judge) {
    using std::sqrt;
    if (start.on_surface && !start.inward) return {};

    const Vec3<Real> from_center = ray.origin - convert<Real>(sphere.center);
    const Real dd = squared_length(ray.direction);
    const Real tau = -dot(from_center, ray.direction) / dd;
    if (start.on_surface) return Crossing<Real>{not_behind(Real(tau + tau)), body, false};

    const Real radius = Real(sphere.radius);
    if (judge.textbook())
        return solve_textbook(dd, Real(dot(from_center, ray.direction)),
                              Real(squared_length(from_center) - radius * radius));
    const Vec3<Real> foot = mul_add(tau, ray.direction, from_center);
    const Real discriminant = mul_add(radius, radius, Real(-squared_length(foot)));
    if (judge.negative(discriminant)) return {};
    const Real half_chord = sqrt(discriminant / dd);
    return {{tau - half_chord, body, true}, {tau + half_chord, body, false}};
}

template <class Real>
Vec3<Real> outward_direction(const Sphere& sphere, const Vec3<Real>& point, Face) {
    return point - convert<Real>(sphere.center);
}

inline ExactQuadratic form_along(const Sphere& sphere, const ExactRay& ray, Face) {
    const Vec3<Dyadic> f = ray.origin - convert<Dyadic>(sphere.center);
    const Dyadic radius = sphere.radius;
    return {squared_length(ray.direction), dot(f, ray.direction),
            squared_length(f) - radius * radius};
}

template <class Real>
NormalAlong<Real> normal_along(const Sphere& sphere, const Ray<Real>& ray, Face) {
    return {ray.origin - convert<Real>(sphere.center), ray.direction};
}

} // namespace raylane::core
