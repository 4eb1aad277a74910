#pragma once

#include "core/scene/staging.hpp"
#include "scenes/export/writers.hpp"

namespace raylane::scenes {

/// Returns the part of a scene's staging that JSON can express, and from which a reader derives the
/// scene's camera, fog and lights, to the bit.
core::Staging staging_in_json(const core::Scene& scene);

/// Returns a phrase for each part of `staging` that is missing in `said`.
Differences lost_staging(const core::Staging& staging, const core::Staging& said);

} // namespace raylane::scenes
