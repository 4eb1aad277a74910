#pragma once

#include "core/shapes/checks.hpp"
#include "core/shapes/form.hpp"
#include "core/shapes/quadratic.hpp"
#include "core/shapes/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raylane::core {

template <class Number>
void validate(const QuadricOf<Number>& q) {
    checks::require_point("center", q.center);
    const Number rows[4][4] = {{q.xx, q.xy, q.xz, q.x},
                               {q.xy, q.yy, q.yz, q.y},
                               {q.xz, q.yz, q.zz, q.z},
                               {q.x, q.y, q.z, q.one}};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            checks::require_coordinate(checks::Field("matrix").at(row).at(column),
                                       rows[row][column]);
    const bool constant = q.xx == 0 && q.yy == 0 && q.zz == 0 && q.xy == 0 && q.xz == 0 &&
                          q.yz == 0 && q.x == 0 && q.y == 0 && q.z == 0;
    if (constant) throw InvalidValue("matrix", "must not be constant, got only the last entry");
    checks::require_point("lower", q.lower);
    checks::require_point("upper", q.upper);
    for (int axis = 0; axis < 3; ++axis)
        if (!(q.lower[axis] < q.upper[axis]))
            checks::refuse(checks::Field("upper").at(axis),
                           "must be more than lower's " + checks::text_of(q.lower[axis]),
                           q.upper[axis]);
}

template <class Number>
Bounds bounds_of(const QuadricOf<Number>& quadric) {
    const Vec3d lower = convert<double>(quadric.lower), upper = convert<double>(quadric.upper);
    const Vec3d center = convert<double>(quadric.center);
    return bounds_around(center + 0.5 * (lower + upper), 0.5 * (upper - lower),
                         absolute(center) + absolute(lower) + absolute(upper));
}

/// Returns M p for the upper left 3x3 part of the form's matrix.
template <class Real, class Number>
Vec3<Real> quadric_product(const QuadricOf<Number>& q, const Vec3<Real>& p) {
    return {dot(Vec3<Real>(Real(q.xx), Real(q.xy), Real(q.xz)), p),
            dot(Vec3<Real>(Real(q.xy), Real(q.yy), Real(q.yz)), p),
            dot(Vec3<Real>(Real(q.xz), Real(q.yz), Real(q.zz)), p)};
}

/// Returns half the gradient of Q at p, relative to the centre.
template <class Real, class Number>
Vec3<Real> quadric_half_gradient(const QuadricOf<Number>& q, const Vec3<Real>& p) {
    return quadric_product(q, p) + Vec3<Real>(Real(q.x), Real(q.y), Real(q.z));
}

/// Returns Q(p), relative to the centre.
template <class Real, class Number>
Real quadric_value(const QuadricOf<Number>& q, const Vec3<Real>& p) {
    const Vec3<Real> linear(Real(q.x), Real(q.y), Real(q.z));
    return dot(p, Vec3<Real>(quadric_half_gradient(q, p) + linear)) + Real(q.one);
}

/// Returns the largest coefficient of direction . M direction: its scale for a unit direction.
template <class Real, class Number>
Real quadric_scale(const QuadricOf<Number>& q) {
    return Real(std::max({std::abs(q.xx), std::abs(q.yy), std::abs(q.zz), std::abs(q.xy),
                          std::abs(q.xz), std::abs(q.yz)}));
}

/// Solves Q(f + t direction) = A t^2 + 2 B t + C = 0, clipped to the box. Its limits may be
/// infinite.
template <class Real, class Number>
Crossings<Real> crossings(const QuadricOf<Number>& quadric, const Ray<Real>& ray,
                          const Start& start, ErrorPredicate<Real>& predicate) {
    const Vec3<Real> from_center = ray.origin - convert<Real>(quadric.center);
    const Vec3<Real> product = quadric_product(quadric, ray.direction);
    const Real A = dot(ray.direction, product);
    const Real B = dot(ray.direction, quadric_half_gradient(quadric, from_center));

    Crossings<Real> roots;
    if (start.on_surface) {
        // t = 0 is one root, -2 B / A the other. The other is ahead if the ray first goes inside
        // and the form rises again, or the reverse. The caller knows the side at the start better
        // than the sign of B.
        const int curvature = predicate.sign(A);
        if (start.inward ? curvature > 0 : curvature < 0)
            roots.add({not_behind(Real(-(B + B) / A)), body, !start.inward});
    } else {
        const Real scale = squared_length(ray.direction) * quadric_scale<Real>(quadric);
        roots = solve_quadratic(
            A, B, quadric_value(quadric, from_center), scale, predicate, [&](const Real& tau) {
                return quadric_value(quadric, Vec3<Real>(mul_add(tau, ray.direction, from_center)));
            });
    }

    Crossings<Real> kept;
    for (const Crossing<Real>& root : roots) {
        const Vec3<Real> p = mul_add(root.t, ray.direction, from_center);
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis)
            inside = inside &&
                     (std::isinf(quadric.lower[axis]) ||
                      !predicate.less(p[axis], Real(quadric.lower[axis]))) &&
                     (std::isinf(quadric.upper[axis]) ||
                      !predicate.less(Real(quadric.upper[axis]), p[axis]));
        if (inside) kept.add(root);
    }
    return kept;
}

/// Returns half the gradient. It vanishes at the apex of a cone.
template <class Real, class Number>
Vec3<Real> outward_direction(const QuadricOf<Number>& quadric, const Vec3<Real>& point, Face) {
    return quadric_half_gradient(quadric, Vec3<Real>(point - convert<Real>(quadric.center)));
}

template <class Real, class Number>
Vec3<Real> apex_direction(const QuadricOf<Number>&) {
    return {Real(0.0), Real(0.0), Real(1.0)};
}

template <class Number>
ExactQuadratic form_along(const QuadricOf<Number>& quadric, const ExactRay& ray, Face) {
    const Vec3<Dyadic> f = ray.origin - convert<Dyadic>(quadric.center);
    return {dot(ray.direction, quadric_product(quadric, ray.direction)),
            dot(ray.direction, quadric_half_gradient(quadric, f)), quadric_value(quadric, f)};
}

template <class Real, class Number>
NormalAlong<Real> normal_along(const QuadricOf<Number>& quadric, const Ray<Real>& ray, Face) {
    const Vec3<Real> f = ray.origin - convert<Real>(quadric.center);
    return {quadric_half_gradient(quadric, f), quadric_product(quadric, ray.direction),
            apex_direction<Real>(quadric)};
}

/// Returns the form, which is negative inside, within the box and beyond it.
template <class Real, class Number>
std::array<Real, 1> forms_at(const QuadricOf<Number>& quadric, const Vec3<Real>& point) {
    return {quadric_value(quadric, Vec3<Real>(point - convert<Real>(quadric.center)))};
}

} // namespace raylane::core
