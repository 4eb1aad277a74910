#pragma once

#include "core/reference/crossing_order.hpp"

/// Numbers of a crossing: the floats nearest to the true values, and doubles as accurate as
/// possible.
namespace raylane::core {

/// Returns t * 2^exponent, rounded to the nearest float, ties to even, but never to 0 or infinity.
/// Uses exact arithmetic only if the error of t leaves the rounding in doubt.
float rounded_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit, int exponent);

/// The same for the nearest double.
double nearest_double_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit,
                        int exponent);

/// Compares a crossing's true t with a number: -1 if t is less, 0 if both are equal, 1 if t is
/// more. Uses exact arithmetic only if the error of t leaves the answer in doubt.
int compare_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit, double number);

/// Returns true if all numbers within `error` of t round to the same float by the rules of
/// rounded_t(). Stores that float in `t_rounded`. Otherwise stores the least of the floats.
bool rounds_surely(double t, double error, float& t_rounded);

/// Returns true if every number within `error` of this sum rounds to its high part, which must not
/// be subnormal: it then still does after scaling by a power of two.
bool rounds_surely(const DoubleDouble& t, double error);

/// Returns the unit normal outside (in front) of the surface at the true point of a crossing, each
/// component rounded to the nearest float, ties to even; 0 is +0. At an edge, the result is the
/// normal of the lowest of the faces that the ray crosses there. At the apex of a cone, it is the
/// axis, pointing outwards. At the apex of a quadric, it is the z axis. `known` holds the
/// components that are known already, and NaN for the others.
Vec3f rounded_normal(const Scene& scene, const LeavingRay& from, const Hit<double>& hit);
Vec3f rounded_normal(const Scene& scene, const LeavingRay& from, const Hit<double>& hit,
                     const Vec3f& known);

/// The same for the nearest double.
Vec3d nearest_double_normal(const Scene& scene, const LeavingRay& from, const SharpHit& hit);

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
