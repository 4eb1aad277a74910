#pragma once

#include "core/shapes/bounds.hpp"
#include "core/shapes/error_predicate.hpp"
#include "core/shapes/form.hpp"

#include <array>

/// Shared parts of cylinders and cones.
namespace raylane::core {

/// Returns the bounds of the frustum between two discs perpendicular to the axis.
Bounds frustum_bounds(const Vec3d& base, const Vec3d& axis, double base_radius, double top_radius);

/// Returns true if two vectors of doubles, as numbers with bounds, are certainly parallel: their
/// cross product is exactly 0. Other numbers leave that to the formulas.
template <class T>
bool are_parallel(const Vec3<Bounded<T>>& v, const Vec3<Bounded<T>>& w) {
    using double_double::are_equal_products;
    const Vec3d a = convert<double>(v), b = convert<double>(w);
    return are_equal_products(a.y, b.z, a.z, b.y) && are_equal_products(a.z, b.x, a.x, b.z) &&
           are_equal_products(a.x, b.y, a.y, b.x);
}
template <class Real>
bool are_parallel(const Vec3<Real>&, const Vec3<Real>&) {
    return false;
}

/// A ray decomposed along and across the axis of a cylinder or cone: with f = origin - base,
///   height(t) = (f + t * direction) . axis, in [0, axis . axis] between the ends,
///   across(t) = across_origin + t * across_direction, the offset from the axis.
/// The quotient axis / |axis|^2 is not rounded first. So the rounding error of the division by
/// |axis|^2 is along the axis and affects `across` only at second order.
///
/// No bound on errors proves that `across_direction` is 0, but are_parallel() does. Axes and
/// directions are exact doubles.
template <class Real>
struct AxialRay {
    Real axis_squared;
    Real height_origin;
    Real height_direction;
    Vec3<Real> across_origin;
    Vec3<Real> across_direction;

    template <class Number>
    AxialRay(const Vec3<Number>& base, const Vec3<Number>& axis, const Ray<Real>& ray) {
        const Vec3<Real> a = convert<Real>(axis);
        const Vec3<Real> from_base = ray.origin - convert<Real>(base);
        axis_squared = squared_length(a);
        height_origin = dot(from_base, a);
        height_direction = dot(ray.direction, a);
        const Divisor<Real> by_axis_squared(axis_squared);
        across_origin = mul_add(Real(-(height_origin / by_axis_squared)), a, from_base);
        across_direction = mul_add(Real(-(height_direction / by_axis_squared)), a, ray.direction);
        if (are_parallel(a, ray.direction)) across_direction = Vec3<Real>(Real(0.0));
    }

    /// Returns true if the crossing is between the ends, including the rims.
    bool between_ends(const Real& t, ErrorPredicate<Real>& predicate) const {
        const Real height = mul_add(t, height_direction, height_origin);
        return !predicate.negative(height) && !predicate.less(axis_squared, height);
    }
};

/// Clips a ray's interval against the caps of a solid. A ray that starts on the surface and goes
/// inward is clipped only against the cap towards which it goes, and never against the cap on which
/// it starts.
template <class Real, class AnyInterval>
void clip_caps(AnyInterval& interval, const AxialRay<Real>& axial, const Start& start,
               ErrorPredicate<Real>& predicate) {
    if (!start.on_surface) {
        interval.clip_slab(axial.height_origin, axial.height_direction, axial.axis_squared,
                           base_cap, top_cap);
        return;
    }
    const int direction = predicate.sign(axial.height_direction);
    if (direction > 0 && start.face != top_cap)
        interval.clip_back((axial.axis_squared - axial.height_origin) / axial.height_direction,
                           top_cap);
    if (direction < 0 && start.face != base_cap)
        interval.clip_back(-axial.height_origin / axial.height_direction, base_cap);
}

/// Returns the crossings of an open surface that are between its ends.
template <class Real>
Crossings<Real> keep_between_ends(const Crossings<Real>& crossings, const AxialRay<Real>& axial,
                                  ErrorPredicate<Real>& predicate) {
    Crossings<Real> kept;
    for (Crossing<Real> crossing : crossings)
        if (predicate.counts(crossing, [&](const Crossing<Real>& it) {
                return axial.between_ends(it.t, predicate);
            }))
            kept.add(crossing);
    return kept;
}

/// Returns the offset from the axis to a point, perpendicular to the axis.
template <class Real, class Number>
Vec3<Real> offset_from_axis(const Vec3<Number>& base, const Vec3<Number>& axis,
                            const Vec3<Real>& point) {
    const Vec3<Real> a = convert<Real>(axis);
    const Vec3<Real> from_base = point - convert<Real>(base);
    return mul_add(Real(-(dot(from_base, a) / squared_length(a))), a, from_base);
}

/// An AxialRay without fractions: `across` is scaled by |axis|^2.
template <class Real>
struct ScaledAxialRay {
    Vec3<Real> axis, from_base, direction;
    Real axis_squared, height_origin, height_direction;

    template <class Number>
    ScaledAxialRay(const Vec3<Number>& base, const Vec3<Number>& axis_, const Ray<Real>& ray)
        : axis(convert<Real>(axis_)), from_base(ray.origin - convert<Real>(base)),
          direction(ray.direction), axis_squared(squared_length(axis)),
          height_origin(dot(from_base, axis)), height_direction(dot(direction, axis)) {}

    /// Returns |across|^2 - width^2, scaled by |axis|^2, for a constant width of `radius`.
    ExactQuadratic pipe(const Real& radius) const {
        return {
            axis_squared * squared_length(direction) - height_direction * height_direction,
            axis_squared * dot(from_base, direction) - height_origin * height_direction,
            pipe_at_origin(radius),
        };
    }
    Real pipe_at_origin(const Real& radius) const {
        return axis_squared * (squared_length(from_base) - radius * radius) -
               height_origin * height_origin;
    }
    NormalAlong<Real> across() const {
        return {axis_squared * from_base - height_origin * axis,
                axis_squared * direction - height_direction * axis};
    }

    ExactQuadratic cap(Face face) const {
        if (face == base_cap) return {0.0, -0.5 * height_direction, -height_origin};
        return {0.0, 0.5 * height_direction, height_origin - axis_squared};
    }
    /// Returns the values at the ray's origin of the forms of body, base cap and top cap.
    /// `body_there` is the value of the body's form.
    std::array<Real, 3> forms_at_origin(const Real& body_there) const {
        return {body_there, -height_origin, height_origin - axis_squared};
    }
    NormalAlong<Real> cap_normal(Face face) const { return {face == base_cap ? -axis : axis}; }
};

} // namespace raylane::core
