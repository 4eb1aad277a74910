#pragma once

#include "tests/meetings/frame.hpp"

/// Shapes that touch the origin from below: with a face, an edge, a corner, a rim, an apex, or
/// where their surface is level. In small whole numbers, so that they do.
namespace raylane::meetings {

inline float radius_of(const Frame& frame, double radius) {
    return static_cast<float>(radius * frame.length());
}

/// Makes shapes of one kind. `r`: a length that shapes which are to coincide share. Some also have
///   Shape shell(frame, r)
/// of which the highest point is the origin, and the center r below it.
template <class Shape>
struct Touching;

} // namespace raylane::meetings
