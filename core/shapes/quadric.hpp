#pragma once

#include "core/shapes/form.hpp"
#include "core/shapes/quadratic.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::core {

/// M p for the upper left 3x3 part of the form's matrix.
template <class Real>
Vec3<Real> quadric_product(const Quadric& q, const Vec3<Real>& p) {
    return {dot(Vec3<Real>(Real(q.xx), Real(q.xy), Real(q.xz)), p),
            dot(Vec3<Real>(Real(q.xy), Real(q.yy), Real(q.yz)), p),
            dot(Vec3<Real>(Real(q.xz), Real(q.yz), Real(q.zz)), p)};
}

/// Half the gradient of Q at p, relative to the centre.
template <class Real>
Vec3<Real> quadric_half_gradient(const Quadric& q, const Vec3<Real>& p) {
    return quadric_product(q, p) + Vec3<Real>(Real(q.x), Real(q.y), Real(q.z));
}

/// Q(p), relative to the centre.
template <class Real>
Real quadric_value(const Quadric& q, const Vec3<Real>& p) {
    const Vec3<Real> linear(Real(q.x), Real(q.y), Real(q.z));
    return dot(p, Vec3<Real>(quadric_half_gradient(q, p) + linear)) + Real(q.one);
}

/// The largest of what direction . M direction can be made of, for a unit direction.
template <class Real>
Real quadric_scale(const Quadric& q) {
    return Real(std::max({std::abs(q.xx), std::abs(q.yy), std::abs(q.zz), std::abs(q.xy),
                          std::abs(q.xz), std::abs(q.yz)}));
}

/// Q(f + t direction) = A t^2 + 2 B t + C, clipped to the box.
template <class Real>
Crossings<Real> crossings(const Quadric& quadric, const Ray<Real>& ray, const Start& start,
                          Judge<Real>& judge) {
    const Vec3<Real> from_center = ray.origin - convert<Real>(quadric.center);
    const Vec3<Real> product = quadric_product(quadric, ray.direction);
    const Real A = dot(ray.direction, product);
    const Real B = dot(ray.direction, quadric_half_gradient(quadric, from_center));

    Crossings<Real> roots;
    if (start.on_surface) {
        // t = 0 is one root, -2 B / A the other: ahead if the ray first falls inside and the form
        // rises again, or the reverse. Which of both it does at the start, the caller knows better
        // than the sign of B.
        const int curvature = judge.sign(A);
        if (start.inward ? curvature > 0 : curvature < 0)
            roots.add({not_behind(Real(-(B + B) / A)), body, !start.inward});
    } else {
        const Real scale = squared_length(ray.direction) * quadric_scale<Real>(quadric);
        roots = solve_quadratic(
            A, B, quadric_value(quadric, from_center), scale, judge, [&](const Real& tau) {
                return quadric_value(quadric, Vec3<Real>(mul_add(tau, ray.direction, from_center)));
            });
    }

    Crossings<Real> kept;
    for (const Crossing<Real>& root : roots) {
        const Vec3<Real> p = mul_add(root.t, ray.direction, from_center);
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis)
            inside = inside && !judge.less(p[axis], Real(quadric.lower[axis])) &&
                     !judge.less(Real(quadric.upper[axis]), p[axis]);
        if (inside) kept.add(root);
    }
    return kept;
}

/// The gradient. It vanishes at the apex of a cone.
template <class Real>
Vec3<Real> outward_direction(const Quadric& quadric, const Vec3<Real>& point, Face) {
    return quadric_half_gradient(quadric, Vec3<Real>(point - convert<Real>(quadric.center)));
}

template <class Real>
Vec3<Real> apex_direction(const Quadric&) {
    return {Real(0.0), Real(0.0), Real(1.0)};
}

inline ExactQuadratic form_along(const Quadric& quadric, const ExactRay& ray, Face) {
    const Vec3<Dyadic> f = ray.origin - convert<Dyadic>(quadric.center);
    return {dot(ray.direction, quadric_product(quadric, ray.direction)),
            dot(ray.direction, quadric_half_gradient(quadric, f)), quadric_value(quadric, f)};
}

template <class Real>
NormalAlong<Real> normal_along(const Quadric& quadric, const Ray<Real>& ray, Face) {
    const Vec3<Real> f = ray.origin - convert<Real>(quadric.center);
    return {quadric_half_gradient(quadric, f), quadric_product(quadric, ray.direction),
            apex_direction<Real>(quadric)};
}

} // namespace raylane::core
