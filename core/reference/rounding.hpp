#pragma once

#include "core/reference/crossing_order.hpp"

/// Answers about a crossing: the floats next to the truth, and doubles as near as double can be.
namespace raylane::core {

/// t * 2^exponent, rounded to the nearest float, ties to even, but never to 0 or infinity. For what
/// is not sure from t and its error alone it is decided exactly.
float rounded_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit, int exponent);

/// t, rounded to the nearest double, ties to even. For what is not sure from t and its error alone
/// it is decided exactly.
double nearest_double_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit);

/// Order of a crossing's true t and a number: -1 if it is less, 0 if they are the same, 1 if it is
/// more. For what is not sure from t and its error alone it is decided exactly.
int compare_t(const Scene& scene, const LeavingRay& from, const Hit<double>& hit, double number);

/// True if every t within `error` of this one rounds to one float as above. That is then
/// `t_rounded`.
bool rounds_surely(double t, double error, float& t_rounded);

/// True if every number within `error` of this sum rounds to its high part.
bool rounds_surely(const DoubleDouble& t, double error);

/// The unit normal outside (in front) of the surface at the true point of a crossing, each
/// component rounded to the nearest float, ties to even; 0 is +0. At an edge it is that of the
/// lowest of the faces which the ray crosses there; at the apex of a cone the axis, to the outside;
/// at that of a quadric z. Components of it that are known already may be given, NaN for others.
Vec3f rounded_normal(const Scene& scene, const LeavingRay& from, const Hit<double>& hit);
Vec3f rounded_normal(const Scene& scene, const LeavingRay& from, const Hit<double>& hit,
                     const Vec3f& known);

/// The same in double, within 2^-40, and the point itself, within 2^-50 of its largest coordinate
/// or of the shape's distance from it.
template <class Real>
struct SurfacePoint {
    Vec3<Real> point;
    Vec3<Real> normal;
};
SurfacePoint<double> surface_point(const Scene& scene, const LeavingRay& from,
                                   const Hit<double>& hit);

} // namespace raylane::core
