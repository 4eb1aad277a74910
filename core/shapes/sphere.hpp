#pragma once

#include "core/shapes/ball.hpp"
#include "core/shapes/checks.hpp"
#include "core/shapes/types.hpp"

namespace raylane::core {

template <class Number>
void validate(const SphereOf<Number>& sphere) {
    checks::require_point("center", sphere.center);
    checks::require_positive("radius", sphere.radius);
}

/// Returns bounds, computed in float, as there may be millions of spheres. A sum has an error of at
/// most half an ulp; a sum that underflows is exact. 2^-23 times a normal sum is at least an ulp,
/// so bounds that are wider by this contain the sphere.
inline Bounds bounds_of(const SphereOf<float>& sphere) {
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const float lower = sphere.center[axis] - sphere.radius;
        const float upper = sphere.center[axis] + sphere.radius;
        bounds.lower[axis] = lower - 0x1p-23F * std::abs(lower);
        bounds.upper[axis] = upper + 0x1p-23F * std::abs(upper);
    }
    return bounds;
}

inline Bounds bounds_of(const SphereOf<double>& sphere) {
    return bounds_around(sphere.center, Vec3d(sphere.radius), absolute(sphere.center));
}

template <class Real, class Number>
Crossings<Real> crossings(const SphereOf<Number>& sphere, const Ray<Real>& ray, const Start& start,
                          ErrorPredicate<Real>& predicate) {
    return ball_crossings(Vec3<Real>(ray.origin - convert<Real>(sphere.center)), ray.direction,
                          Real(sphere.radius), start, predicate);
}

template <class Real, class Number>
Vec3<Real> outward_direction(const SphereOf<Number>& sphere, const Vec3<Real>& point, Face) {
    return point - convert<Real>(sphere.center);
}

template <class Number>
ExactQuadratic form_along(const SphereOf<Number>& sphere, const ExactRay& ray, Face) {
    return ball_along(ray.origin - convert<Dyadic>(sphere.center), ray.direction, sphere.radius);
}

template <class Real, class Number>
NormalAlong<Real> normal_along(const SphereOf<Number>& sphere, const Ray<Real>& ray, Face) {
    return {ray.origin - convert<Real>(sphere.center), ray.direction};
}

template <class Real, class Number>
std::array<Real, 1> forms_at(const SphereOf<Number>& sphere, const Vec3<Real>& point) {
    return {ball_at(Vec3<Real>(point - convert<Real>(sphere.center)), Real(sphere.radius))};
}

} // namespace raylane::core
