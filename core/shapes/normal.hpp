#pragma once

#include "core/shapes/ray.hpp"
#include "core/shapes/shapes.hpp"

/// Each shape has
///   Vec3<Real> outward_direction(shape, point, face)
/// the normal outside (in front) at a point of its surface, of any length. If it may vanish, at an
/// apex, the shape also has a replacement:
///   Vec3<Real> apex_direction<Real>(shape)
namespace raylane::core {

/// Returns the outward normal of length 1.
template <class Real, class Shape>
Vec3<Real> outward_normal(const Shape& shape, const Vec3<Real>& point, Face face) {
    const Vec3<Real> direction = outward_direction(shape, point, face);
    if constexpr (requires { apex_direction<Real>(shape); })
        if (face == body && !(squared_length(direction) > Real(0.0)))
            return normalized(apex_direction<Real>(shape));
    return normalized(direction);
}

} // namespace raylane::core
