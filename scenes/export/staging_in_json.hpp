#pragma once

#include "core/scene/staging.hpp"
#include "scenes/export/writers.hpp"

namespace raylane::scenes {

/// As much of a scene's staging as JSON has words for, and by which a reader finds camera, fog and
/// lights to the bit as the scene has them.
core::Staging staging_in_json(const core::Scene& scene);

/// What of `staging` is not in `said`, in words.
Differences lost_staging(const core::Staging& staging, const core::Staging& said);

} // namespace raylane::scenes
