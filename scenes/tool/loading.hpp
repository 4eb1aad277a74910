#pragma once

#include "core/scene/scene.hpp"
#include "scenes/scene_file.hpp"
#include "scenes/tool/options/scene_options.hpp"

#include <filesystem>

namespace raylane::scenes {

/// Calls load_scene() with `threads` threads (0: default_threads()) and shows a line of progress.
/// Remarks on the file go to standard error, unless `verbosity` is quiet.
core::Scene load_with_progress(const std::filesystem::path& path, LoadOptions options,
                               Verbosity verbosity, int threads = 0);

/// Does the same with the options of a command, and returns the scene with the view that they
/// request.
core::Scene load_seen(const std::string& scene, const SceneArguments& options, int threads = 0);

} // namespace raylane::scenes
