#pragma once

#include "core/scene/scene.hpp"
#include "scenes/structure/legend.hpp"

#include <string>

namespace raylane::scenes {

/// What a camera sees through the middle of a pixel of a picture of the settings' size, in one
/// line: which atom by the legend, which shape, its material's number and name, where, how far
/// away, as real arithmetic says.
std::string what_is_at(const core::Scene& scene, const core::Settings& settings, int x, int y,
                       const Legend& legend = {});

/// A scene's camera as its JSON says it: `"camera": {...}`.
std::string camera_text(const core::Camera& camera);

} // namespace raylane::scenes
