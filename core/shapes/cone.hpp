#pragma once

#include "core/shapes/axial.hpp"
#include "core/shapes/checks.hpp"
#include "core/shapes/clip_interval.hpp"
#include "core/shapes/quadratic.hpp"
#include "core/shapes/types.hpp"

namespace raylane::core {

template <class Number, Ends ends>
void validate(const ConeOf<Number, ends>& cone) {
    checks::require_point("base", cone.base);
    checks::require_direction("axis", cone.axis);
    checks::require_not_negative("base_radius", cone.base_radius);
    checks::require_not_negative("top_radius", cone.top_radius);
    if (cone.base_radius == 0 && cone.top_radius == 0)
        throw InvalidValue("base_radius", "must be positive if top_radius is 0, got 0");
}

template <class Number, Ends ends>
Bounds bounds_of(const ConeOf<Number, ends>& cone) {
    return frustum_bounds(convert<double>(cone.base), convert<double>(cone.axis),
                          static_cast<double>(cone.base_radius),
                          static_cast<double>(cone.top_radius));
}

/// Solves |across(t)|^2 = width(t)^2, where the width runs from base_radius to top_radius along the
/// axis:
///   F(t) = |across|^2 - width^2 = A * t^2 + 2 * B * t + C,  width(t) = W + t * M.
/// The equation also describes the mirror nappe beyond the apex, where width < 0. Between the ends,
/// width >= 0. So crossings that are clipped to the ends need a separate test at the apex alone: a
/// ray through the apex, from the inside of one nappe to the inside of the other, crosses both
/// nappes there.
///
/// Drawing: bench/drawings/cone_nappes.svg
template <class Real, class Number, Ends ends>
Crossings<Real> crossings(const ConeOf<Number, ends>& cone, const Ray<Real>& ray,
                          const Start& start, ErrorPredicate<Real>& predicate) {
    if (start.on_surface && !start.inward) return {};

    const AxialRay<Real> axial(cone.base, cone.axis, ray);
    const Real base_radius = Real(cone.base_radius);
    const Real slope = (Real(cone.top_radius) - base_radius) / axial.axis_squared;
    const Real W = mul_add(slope, axial.height_origin, base_radius);
    const Real M = slope * axial.height_direction;
    const Real across_squared = squared_length(axial.across_direction);
    const Real A = mul_add(Real(-M), M, across_squared);
    const Real B = mul_add(Real(-M), W, dot(axial.across_origin, axial.across_direction));

    // The infinite double cone.
    Crossings<Real> roots;
    const int curvature = predicate.sign(A);
    if (start.on_surface && start.face == body) {
        // t = 0 is one root, -2 * B / A the other. Going inward, F falls at 0, so it rises again
        // only if A > 0.
        if (curvature > 0) roots.add({not_behind(Real(-(B + B) / A)), body, false});
    } else {
        const Real C = mul_add(Real(-W), W, squared_length(axial.across_origin));
        roots = solve_quadratic(
            A, B, C, mul_add(M, M, across_squared), predicate, [&](const Real& tau) {
                const Real width = mul_add(tau, M, W);
                return mul_add(
                    Real(-width), width,
                    squared_length(mul_add(tau, axial.across_direction, axial.across_origin)));
            });
        // Without roots, the line is outside of the cone or inside of the double cone for all t.
        // Inside, it can only cross the caps.
        const bool no_roots = roots.begin() == roots.end();
        if (no_roots && (curvature > 0 || predicate.positive(C))) {
            if (!start.on_surface) return {};
            // The ray starts on a cap, at its rim: it leaves, whatever the rounding.
            const Real vertex = curvature > 0 ? Real(-B / A) : Real(0.0);
            roots.add({not_behind(vertex), body, false});
        }
    }
    // The line crosses each nappe once: it is inside before the first crossing and behind the
    // second. If M > 0, the width grows with t, so the nappe with width >= 0 is the second.
    if (curvature < 0) {
        const bool enters = predicate.sign(M) > 0;
        Crossings<Real> on_nappe;
        for (const Crossing<Real>& root : roots)
            if (root.entering == enters) on_nappe.add(root);
        roots = on_nappe;
    }
    if constexpr (ends == Ends::open) return keep_between_ends(roots, axial, predicate);

    // The solid is convex: clip to the nappe between the ends.
    ClipInterval<Real> interval(predicate);
    for (const Crossing<Real>& root : roots) {
        if (root.entering && !start.on_surface) interval.clip_front(root.t, root.face);
        if (!root.entering) interval.clip_back(root.t, root.face);
    }
    clip_caps(interval, axial, start, predicate);
    return start.on_surface ? interval.exit() : interval.crossings();
}

/// Returns a vector along the outward normal. On a cap, it is the axis or its opposite. On the
/// body, it is half the gradient of F as in crossings(), across - width * slope * axis, where
/// `across` is the offset from the axis to the point. This vector vanishes at the apex.
template <class Real, class Number, Ends ends>
Vec3<Real> outward_direction(const ConeOf<Number, ends>& cone, const Vec3<Real>& point, Face face) {
    const Vec3<Real> axis = convert<Real>(cone.axis);
    if (face == base_cap) return -axis;
    if (face == top_cap) return axis;
    const Vec3<Real> across = offset_from_axis(cone.base, cone.axis, point);
    const Real narrowing = Real(cone.base_radius) - Real(cone.top_radius);
    // On the surface, width = |across|. Using |across| gives the right direction even if the point
    // is a little off the surface.
    const Real width = length(across);
    return mul_add(Real(width * narrowing / squared_length(axis)), axis, across);
}

/// Returns the axis, pointing outwards.
template <class Real, class Number, Ends ends>
Vec3<Real> apex_direction(const ConeOf<Number, ends>& cone) {
    const Vec3<Real> axis = convert<Real>(cone.axis);
    return cone.top_radius < cone.base_radius ? axis : -axis;
}

/// The cone's width along a ray, scaled by |axis|^2: origin + t * direction.
template <class Real>
struct ScaledWidth {
    Real widening, origin, direction;

    template <class Number>
    ScaledWidth(Number base_radius, Number top_radius, const ScaledAxialRay<Real>& axial)
        : widening(Real(top_radius) - Real(base_radius)),
          origin(Real(base_radius) * axial.axis_squared + widening * axial.height_origin),
          direction(widening * axial.height_direction) {}
};

template <class Number, Ends ends>
ExactQuadratic form_along(const ConeOf<Number, ends>& cone, const ExactRay& ray, Face face) {
    const ScaledAxialRay<Dyadic> axial(cone.base, cone.axis, ray);
    if (face != body) return axial.cap(face);
    const ScaledWidth<Dyadic> width(cone.base_radius, cone.top_radius, axial);
    const auto [A, B, C] = axial.pipe(0.0);
    return {axial.axis_squared * A - width.direction * width.direction,
            axial.axis_squared * B - width.origin * width.direction,
            axial.axis_squared * C - width.origin * width.origin};
}

template <class Real, class Number, Ends ends>
NormalAlong<Real> normal_along(const ConeOf<Number, ends>& cone, const Ray<Real>& ray, Face face) {
    const ScaledAxialRay<Real> axial(cone.base, cone.axis, ray);
    if (face != body) return axial.cap_normal(face);
    const ScaledWidth<Real> width(cone.base_radius, cone.top_radius, axial);
    const NormalAlong<Real> across = axial.across();
    const Real at_origin = width.widening * width.origin, along = width.widening * width.direction;
    return {axial.axis_squared * across.v - at_origin * axial.axis,
            axial.axis_squared * across.slope - along * axial.axis, apex_direction<Real>(cone)};
}

template <class Real, class Number>
std::array<Real, 3> forms_at(const ConeOf<Number, Ends::capped>& cone, const Vec3<Real>& point) {
    const ScaledAxialRay<Real> axial(cone.base, cone.axis, Ray<Real>{point, {}});
    const ScaledWidth<Real> width(cone.base_radius, cone.top_radius, axial);
    return axial.forms_at_origin(axial.axis_squared * axial.pipe_at_origin(Real(0.0)) -
                                 width.origin * width.origin);
}

} // namespace raylane::core
