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

/// The half-space that is left.
core::Solid half_space_of(const TachyonClip& clip);

/// What is left of a triangle, as a fan of triangles that have an area; its corners are rounded to
/// floats where it was cut.
std::vector<core::Triangle> clipped(const core::Triangle& triangle,
                                    std::span<const TachyonClip> clips);
/// The same of one whose normals change evenly.
std::vector<core::SmoothTriangle> clipped(const core::SmoothTriangle& triangle,
                                          std::span<const TachyonClip> clips);

} // namespace raylane::scenes
