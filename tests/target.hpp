#pragma once

#include "core/shapes/types.hpp"
#include "tests/random.hpp"

/// Random shapes, and where to aim at them.
namespace raylane::ray_sets {

/// A shape with a way to point at it: points on it, tangents there, and the directions special to
/// it.
template <class Shape>
struct Target;

struct SurfacePoint {
    Vec3d point;
    Vec3d normal;
};

} // namespace raylane::ray_sets
