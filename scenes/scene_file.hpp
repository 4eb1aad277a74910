#pragma once

#include "core/scene.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace raylane::scenes {

/// Reads a scene, JSON or NFF. The format follows the file's ending (.json, .nff) or else its
/// content. Throws BadInput for what is malformed, with file and place, and SystemRefused.
core::Scene load_scene(const std::filesystem::path& path);

/// The same for the text of a file; `name` is what messages call it.
core::Scene parse_scene(const std::string& name, std::string_view text);

} // namespace raylane::scenes
