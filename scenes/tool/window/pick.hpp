#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/structure/structure_file.hpp"

#include <string>

namespace raylane::scenes {

/// Returns one line about the shape that a camera sees through the middle of a pixel, in an image
/// of the settings' size: its atom in the legend, the shape, the number and name of its material,
/// the point, and the exact distance, rounded.
std::string what_is_at(const core::Scene& scene, const core::Settings& settings, int x, int y,
                       const Legend& legend = {});

/// Returns a camera in the form of JSON scenes: `"camera": {...}`.
std::string camera_text(const core::Camera& camera);

} // namespace raylane::scenes
