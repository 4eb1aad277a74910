#pragma once

#include "core/scene/scene.hpp"
#include "scenes/export/json_object.hpp"
#include "scenes/export/json_surroundings.hpp"

namespace raylane::scenes {

/// Writes all shapes, in the order of their ids. Throws core::InvalidValue for a solid that is
/// nested deeper than the reader accepts.
void write_objects(JsonObject& root, TextFile& file, const core::Scene& scene,
                   const MaterialNames& names);
/// Writes only constructed solids.
void write_solids(JsonObject& root, TextFile& file, const core::Scene& scene,
                  const MaterialNames& names);

} // namespace raylane::scenes
