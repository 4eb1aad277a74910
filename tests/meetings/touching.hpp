#pragma once

#include "tests/meetings/frame.hpp"

/// Shapes that touch the origin from below: with a face, an edge, a corner, a rim, an apex, or a
/// point where their surface is level. Their numbers are small integers, so that they touch
/// exactly.
namespace raylane::meetings {

inline float radius_of(const Frame& frame, double radius) {
    return static_cast<float>(radius * frame.length());
}

/// Makes shapes of one kind. Shapes that are to coincide share the length `r`. Some kinds also have
///   Shape shell(frame, r)
/// which has its highest point at the origin, and its centre r below.
template <class Shape>
struct Touching;

} // namespace raylane::meetings
