#pragma once

#include "core/numbers/exact_root.hpp"
#include "core/shapes/ray.hpp"

/// Surfaces along a ray, without fractions: what orders and rounds crossings where no digits can.
/// Each shape has
///   ExactQuadratic form_along(shape, ray, face)
/// which is 0 where the line crosses the surface that the face is a part of, and < 0 inside, and
///   NormalAlong<Real> normal_along(shape, ray, face)
/// the outward normal where it does.
namespace raylane::core {

using ExactRay = Ray<Dyadic>;

/// v + t slope, of any length. At an apex that is 0, and `apex` stands in for it.
template <class Real>
struct NormalAlong {
    Vec3<Real> v;
    Vec3<Real> slope{Real(0.0), Real(0.0), Real(0.0)};
    Vec3<Real> apex{Real(0.0), Real(0.0), Real(0.0)};
};

/// normal . (point + t direction) = 0, for a normal that points outside.
inline ExactQuadratic plane_along(const Vec3<Dyadic>& normal, const Vec3<Dyadic>& point,
                                  const Vec3<Dyadic>& direction) {
    return {0.0, 0.5 * dot(normal, direction), dot(normal, point)};
}

} // namespace raylane::core
