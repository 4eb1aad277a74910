#pragma once

#include "core/scene/scene.hpp"
#include "scenes/input_file.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace raylane::scenes {

struct LoadOptions {
    core::Workers* workers = nullptr; ///< who builds the hierarchy; default: the caller's thread
    OnRead on_read;
};

/// Reads a scene, JSON or NFF. The format follows the file's ending (.json, .nff) or else its
/// content. Throws BadInput for what is malformed, with file and place, and SystemRefused.
core::Scene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// The same for the text of a file; `name` is what messages call it.
core::Scene parse_scene(const std::string& name, std::string_view text,
                        const LoadOptions& options = {});

} // namespace raylane::scenes
