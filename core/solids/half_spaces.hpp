#pragma once

#include "core/shapes/bounds.hpp"
#include "core/solids/solid.hpp"

#include <span>

namespace raylane::core {

/// One side of a plane, or of a quadric's complete surface: the quadric's box does not count.
struct HalfSpace {
    PartShape shape;
    bool reversed = false; ///< the outside
};

/// Returns bounds of the points that are in all half-spaces, exactly: never too small. Shapes other
/// than planes and quadrics are ignored. All axes are infinite unless a sum of the forms is an
/// ellipsoid's: of a quadric, of two quadrics, or of a quadric between planes.
Bounds bounds_of_common(std::span<const HalfSpace> half_spaces);

/// Returns the same surface with its box around all of some bounds.
QuadricOf<double> within(QuadricOf<double> quadric, const Bounds& bounds);

} // namespace raylane::core
