#pragma once

#include "core/shapes/types.hpp"
#include "tests/random.hpp"

/// Random shapes, and points to aim at.
namespace raylane::ray_sets {

/// Makes a shape and ways to aim at it: points on it, tangents there, and the shape's special
/// directions.
template <class Shape>
struct Target;

struct SurfacePoint {
    Vec3d point;
    Vec3d normal;
};

} // namespace raylane::ray_sets
