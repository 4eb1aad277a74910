#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/tool/options/scene_options.hpp"
#include "scenes/tool/ranks/job.hpp"
#include "simd/isa/isa.hpp"

#include <filesystem>
#include <functional>
#include <optional>

namespace raylane::scenes {

/// Calls load_scene() with `threads` threads (0: default_threads()) and shows a line of progress.
/// `isa`: the instruction set that will trace the scene; unset: the widest available one.
/// Remarks on the file go to standard error, unless `verbosity` is quiet.
core::Scene load_with_progress(const std::filesystem::path& path, LoadOptions options,
                               Verbosity verbosity, int threads, std::optional<simd::Isa> isa = {});

/// Does the same with the options of a command, and returns the scene with the view that they
/// request. `on_structure` receives the atoms of a file of atoms.
core::Scene load_seen(const std::string& scene, const SceneArguments& options, int threads = 0,
                      const std::function<void(const Structure&)>& on_structure = {});

/// Collective: returns the scene of a file, which `load` loads with a number of threads. Of several
/// ranks on one host, the first loads it with the threads of all of them, and the others share its
/// shapes in memory. Ranks that cannot share load it themselves. A built file is in memory only
/// once in any case, so each rank loads it. Standard input ("-") is shared first. Throws the same
/// as Job::together().
core::Scene load_together(Job& job, const std::filesystem::path& path, int threads,
                          const std::function<core::Scene(int)>& load);

} // namespace raylane::scenes
