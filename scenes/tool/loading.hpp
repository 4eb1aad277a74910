#pragma once

#include "core/scene/scene.hpp"

#include <filesystem>

namespace raylane::scenes {

/// load_scene with `threads` threads (0: all that the machine has), and on a terminal with a line
/// that shows how far it is.
core::Scene load_with_progress(const std::filesystem::path& path, int threads = 0);

} // namespace raylane::scenes
