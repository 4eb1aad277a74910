#pragma once

#include "core/scene/scene.hpp"
#include "scenes/tool/ranks/job.hpp"

#include <filesystem>
#include <functional>

namespace raylane::scenes {

/// Collective: returns the scene of a file, which `load` loads with a number of threads. Of several
/// ranks on one host, the first loads it with the threads of all of them, and the others share its
/// shapes in memory. Ranks that cannot share load it themselves. A built file is in memory only
/// once in any case, so each rank loads it. Standard input ("-") is shared first. Throws the same
/// as Job::together().
core::Scene load_together(Job& job, const std::filesystem::path& path, int threads,
                          const std::function<core::Scene(int)>& load);

} // namespace raylane::scenes
