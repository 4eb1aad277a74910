#pragma once

#include "core/scene/scene.hpp"
#include "scenes/input_file.hpp"

#include <map>
#include <string>

namespace raylane::scenes {

/// Reads a scene in raylane's own format, whose schema is scenes/raylane-scene.schema.json.
/// `workers` build the hierarchy, if there are any. `parameters`: what "$name" stands for in place
/// of what the file says; each has to be used.
/// Throws BadInput, with the position of each mistake, and a JSON pointer unless the text is not
/// JSON: the first mistake in each object, material, light and so on, and all keys that nobody
/// knows, up to InputErrors::most.
core::Scene read_json(InputFile& file, core::Workers* workers = nullptr,
                      const std::map<std::string, double>& parameters = {});

/// The same of a scene whose shapes were built before, and are not in the file.
core::Scene read_json_with(InputFile& file, core::BuiltShapes shapes, core::Workers* workers);

} // namespace raylane::scenes
