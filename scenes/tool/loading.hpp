#pragma once

#include "core/scene/scene.hpp"
#include "scenes/tool/drawing_arguments.hpp"

#include <filesystem>

namespace raylane::scenes {

/// load_scene with `threads` threads (0: all that the machine has), and on a terminal with a line
/// that shows how far it is. Remarks on the file go to standard error.
core::Scene load_with_progress(const std::filesystem::path& path, const Drawing& drawing,
                               const std::string& option_for_atoms, int threads = 0);

} // namespace raylane::scenes
