#pragma once

#include "core/numbers/exact_root.hpp"
#include "core/shapes/ray.hpp"

/// Surfaces along a ray, without fractions. They order and round crossings that no number of digits
/// decides. Each shape has two functions.
///   ExactQuadratic form_along(shape, ray, face)
/// returns a form that is 0 where the line crosses the surface that contains the face, and < 0
/// inside.
///   NormalAlong<Real> normal_along(shape, ray, face)
/// returns the outward normal at the crossing.
namespace raylane::core {

using ExactRay = Ray<Dyadic>;

/// A normal v + t slope, of any length. At an apex it is 0, and `apex` replaces it.
template <class Real>
struct NormalAlong {
    Vec3<Real> v;
    Vec3<Real> slope{Real(0.0), Real(0.0), Real(0.0)};
    Vec3<Real> apex{Real(0.0), Real(0.0), Real(0.0)};
};

/// Returns normal . (point + t direction), for a normal that points outside.
inline ExactQuadratic plane_along(const Vec3<Dyadic>& normal, const Vec3<Dyadic>& point,
                                  const Vec3<Dyadic>& direction) {
    return {0.0, 0.5 * dot(normal, direction), dot(normal, point)};
}

} // namespace raylane::core
