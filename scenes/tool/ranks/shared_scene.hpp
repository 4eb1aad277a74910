#pragma once

#include "core/scene/scene.hpp"
#include "scenes/tool/ranks/job.hpp"

#include <functional>

namespace raylane::scenes {

/// All together: the scene that `load` gives, with so many threads. Of several ranks on one host
/// the first loads it, by as many threads as it may have for all of them, and the others have its
/// shapes in the same memory; those that cannot, load it themselves. Errors are those of
/// Job::together.
core::Scene load_together(Job& job, int threads, const std::function<core::Scene(int)>& load);

} // namespace raylane::scenes
