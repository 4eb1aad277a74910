#pragma once

#include "core/shapes/axial.hpp"
#include "core/shapes/checks.hpp"
#include "core/shapes/clip_interval.hpp"
#include "core/shapes/quadratic.hpp"
#include "core/shapes/types.hpp"

namespace raylane::core {

template <class Number, Ends ends>
void validate(const CylinderOf<Number, ends>& cylinder) {
    checks::require_point("base", cylinder.base);
    checks::require_direction("axis", cylinder.axis);
    checks::require_positive("radius", cylinder.radius);
}

template <class Number, Ends ends>
Bounds bounds_of(const CylinderOf<Number, ends>& cylinder) {
    const auto radius = static_cast<double>(cylinder.radius);
    return frustum_bounds(convert<double>(cylinder.base), convert<double>(cylinder.axis), radius,
                          radius);
}

/// Solves |across(t)| = radius like a sphere, at the foot of the perpendicular from the axis.
///
/// Drawing: bench/drawings/cylinder_foot.svg
template <class Real, class Number, Ends ends>
Crossings<Real> crossings(const CylinderOf<Number, ends>& cylinder, const Ray<Real>& ray,
                          const Start& start, ErrorPredicate<Real>& predicate) {
    using std::sqrt;
    if (start.on_surface && !start.inward) return {};

    const AxialRay<Real> axial(cylinder.base, cylinder.axis, ray);
    const Real radius = Real(cylinder.radius);
    const Real speed_squared = squared_length(axial.across_direction);
    const Divisor<Real> by_speed_squared(speed_squared);
    const bool parallel = predicate.sign(speed_squared) == 0;
    const Real tau =
        parallel ? Real(0.0)
                 : Real(-dot(axial.across_origin, axial.across_direction)) / by_speed_squared;

    ClipInterval<Real> interval(predicate);
    const bool from_body = start.on_surface && start.face == body;
    if (from_body && !parallel) interval.clip_back(not_behind(Real(tau + tau)), body);
    if (predicate.textbook() && !start.on_surface) {
        const Real C = squared_length(axial.across_origin) - radius * radius;
        if (parallel) {
            if (static_cast<double>(C) > 0.0) return {};
        } else {
            const Crossings<Real> roots = solve_textbook(
                speed_squared, Real(dot(axial.across_origin, axial.across_direction)), C);
            if (roots.begin() == roots.end()) return {};
            for (const Crossing<Real>& root : roots)
                root.entering ? interval.clip_front(root.t, body)
                              : interval.clip_back(root.t, body);
        }
    } else if (!from_body) {
        const Vec3<Real> foot = mul_add(tau, axial.across_direction, axial.across_origin);
        Real discriminant = mul_add(radius, radius, Real(-squared_length(foot)));
        if (predicate.negative(discriminant)) {
            if (!start.on_surface) return {};
            // The ray starts on a cap, at its rim: it leaves, whatever the rounding.
            discriminant = Real(0.0);
        }
        if (!parallel) {
            const Real half_chord = sqrt(Real(discriminant / by_speed_squared));
            if (!start.on_surface) interval.clip_front(tau - half_chord, body);
            interval.clip_back(tau + half_chord, body);
        }
    }

    if constexpr (ends == Ends::open)
        return keep_between_ends(start.on_surface ? interval.exit() : interval.crossings(), axial,
                                 predicate);
    clip_caps(interval, axial, start, predicate);
    return start.on_surface ? interval.exit() : interval.crossings();
}

template <class Real, class Number, Ends ends>
Vec3<Real> outward_direction(const CylinderOf<Number, ends>& cylinder, const Vec3<Real>& point,
                             Face face) {
    const Vec3<Real> axis = convert<Real>(cylinder.axis);
    if (face == base_cap) return -axis;
    if (face == top_cap) return axis;
    return offset_from_axis(cylinder.base, cylinder.axis, point);
}

template <class Number, Ends ends>
ExactQuadratic form_along(const CylinderOf<Number, ends>& cylinder, const ExactRay& ray,
                          Face face) {
    const ScaledAxialRay<Dyadic> axial(cylinder.base, cylinder.axis, ray);
    return face == body ? axial.pipe(cylinder.radius) : axial.cap(face);
}

template <class Real, class Number, Ends ends>
NormalAlong<Real> normal_along(const CylinderOf<Number, ends>& cylinder, const Ray<Real>& ray,
                               Face face) {
    const ScaledAxialRay<Real> axial(cylinder.base, cylinder.axis, ray);
    return face == body ? axial.across() : axial.cap_normal(face);
}

template <class Real, class Number>
std::array<Real, 3> forms_at(const CylinderOf<Number, Ends::capped>& cylinder,
                             const Vec3<Real>& point) {
    const ScaledAxialRay<Real> axial(cylinder.base, cylinder.axis, Ray<Real>{point, {}});
    return axial.forms_at_origin(axial.pipe_at_origin(Real(cylinder.radius)));
}

} // namespace raylane::core
