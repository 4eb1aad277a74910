#pragma once

#include "core/scene/scene.hpp"
#include "scenes/export/json_object.hpp"
#include "scenes/export/json_surroundings.hpp"

namespace raylane::scenes {

/// All shapes, in the order of their ids. Throws core::InvalidValue for a solid that is nested
/// deeper than any that is read.
void write_objects(JsonObject& root, TextFile& file, const core::Scene& scene,
                   const MaterialNames& names);
/// Solids that are made of others, alone.
void write_solids(JsonObject& root, TextFile& file, const core::Scene& scene,
                  const MaterialNames& names);

} // namespace raylane::scenes
