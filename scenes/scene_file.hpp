#pragma once

#include "core/scene.hpp"

#include <filesystem>

namespace raylane::scenes {

/// Reads a scene, JSON or NFF. The format follows the file's ending (.json, .nff) or else its
/// content. Throws BadInput for what is malformed, with file and place, and SystemRefused.
core::Scene load_scene(const std::filesystem::path& path);

} // namespace raylane::scenes
