#pragma once

#include "core/reference/crossing_order.hpp"

/// Numbers of a crossing: the floats nearest to the true values, and doubles as accurate as
/// possible.
namespace raylane::core {

/// Returns t * 2^exponent, rounded to the nearest float, ties to even, but never to 0 or infinity.
/// Decides exactly if t and its error alone leave a doubt.
float rounded_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit, int exponent);

/// Returns t, rounded to the nearest double, ties to even. Decides exactly if t and its error alone
/// leave a doubt.
double nearest_double_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit);

/// Compares a crossing's true t with a number: -1 if it is less, 0 if both are equal, 1 if it is
/// more. Decides exactly if t and its error alone leave a doubt.
int compare_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit, double number);

/// Returns true if every t within `error` of this one rounds to the same float, as by rounded_t().
/// Stores that float in `t_rounded`, or otherwise the least of them.
bool rounds_surely(double t, double error, float& t_rounded);

/// Returns true if every number within `error` of this sum rounds to its high part.
bool rounds_surely(const DoubleDouble& t, double error);

/// Returns the unit normal outside (in front) of the surface at the true point of a crossing, each
/// component rounded to the nearest float, ties to even; 0 is +0. At an edge, it is the normal of
/// the lowest of the faces that the ray crosses there. At the apex of a cone, it is the axis, to
/// the outside; at that of a quadric, z. `known` gives components that are known already, and NaN
/// for the others.
Vec3f rounded_normal(const Scene& scene, const LeavingRay& from, const Hit<double>& hit);
Vec3f rounded_normal(const Scene& scene, const LeavingRay& from, const Hit<double>& hit,
                     const Vec3f& known);

/// The normal in double, within 2^-40, and the point itself, within 2^-50 of its largest coordinate
/// or of the shape's distance from it.
template <class Real>
struct SurfacePoint {
    Vec3<Real> point;
    Vec3<Real> normal;
};
SurfacePoint<double> surface_point(const Scene& scene, const LeavingRay& from,
                                   const Hit<double>& hit);

} // namespace raylane::core
