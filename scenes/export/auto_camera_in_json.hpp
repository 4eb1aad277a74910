#pragma once

#include "core/scene/auto_camera.hpp"
#include "scenes/export/writers.hpp"

namespace raylane::scenes {

/// Returns the part of a scene's automatic camera that JSON can express, and from which a reader
/// derives the scene's camera, fog and lights, to the bit.
core::AutoCamera auto_camera_in_json(const core::Scene& scene);

/// Returns a phrase for each part of `auto_camera` that is missing in `said`.
Differences lost_auto_camera(const core::AutoCamera& auto_camera, const core::AutoCamera& said);

} // namespace raylane::scenes
