#pragma once

#include "core/scene/scene.hpp"
#include "scenes/tool/ranks/job.hpp"

#include <filesystem>
#include <functional>

namespace raylane::scenes {

/// All together: the scene that `load` gives of a file, with so many threads. Of several ranks on
/// one host the first loads it, by as many threads as it may have for all of them, and the others
/// have its shapes in the same memory; those that cannot, load it themselves. What is built already
/// is in memory once anyway, and each loads it. Standard input ("-") is shared first. Errors are
/// those of Job::together.
core::Scene load_together(Job& job, const std::filesystem::path& path, int threads,
                          const std::function<core::Scene(int)>& load);

} // namespace raylane::scenes
