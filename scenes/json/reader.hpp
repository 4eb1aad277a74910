#pragma once

#include "core/scene/scene.hpp"
#include "scenes/input_file.hpp"

namespace raylane::scenes {

/// Reads a scene in raylane's own format, whose schema is scenes/raylane-scene.schema.json.
/// `workers` build the hierarchy, if there are any.
/// Throws BadInput, whose place is a JSON pointer, or line and column where the text is not JSON.
core::Scene read_json(InputFile& file, core::Workers* workers = nullptr);

} // namespace raylane::scenes
