#pragma once

#include "core/scene/scene.hpp"

#include <span>
#include <vector>

namespace raylane::scenes {

/// A plane that cuts off the points p with normal . p > offset.
struct TachyonClip {
    core::Vec3f normal;
    float offset;
};

/// Returns the half-space that the plane does not cut off.
core::Solid half_space_of(const TachyonClip& clip);

/// Returns the uncut part of a triangle, as a fan of triangles with an area. Corners where it was
/// cut are rounded to floats.
std::vector<core::Triangle> clipped(const core::Triangle& triangle,
                                    std::span<const TachyonClip> clips);
/// Returns the uncut part of a triangle with interpolated normals.
std::vector<core::SmoothTriangle> clipped(const core::SmoothTriangle& triangle,
                                          std::span<const TachyonClip> clips);

} // namespace raylane::scenes
