#pragma once

#include "core/scene/scene.hpp"
#include "scenes/files/input_file.hpp"

#include <cstddef>
#include <map>
#include <string>

namespace raylane::scenes {

/// The most levels of objects and lists in an object of a scene, for readers and writers.
inline constexpr std::size_t max_levels = 256;

/// Reads a scene in raylane's own format, whose schema is scenes/raylane-scene.schema.json.
/// `workers` build the hierarchy, if set. `parameters`: values of "$name" that override those of
/// the file; each has to be used. Throws BadInput, with the position of each error, and a JSON
/// pointer unless the text is not JSON. It has the first error in each object, material, light and
/// so on, and all unknown keys, up to InputErrors::most.
core::Scene read_json(InputFile& file, core::Workers* workers = nullptr,
                      const std::map<std::string, double>& parameters = {});

/// Reads a scene whose shapes were built before and are not in the file.
core::Scene read_json_with(InputFile& file, core::BuiltShapes shapes, core::Workers* workers);

} // namespace raylane::scenes
