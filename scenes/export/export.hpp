#pragma once

#include "core/scene/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace raylane::scenes {

/// Writes a scene, in the format that the file's ending names, in any case: .json (raylane's own),
/// .nff (of the Standard Procedural Databases), .pov (POV-Ray 3.7's), or .rl (as it is in memory,
/// see scenes/built). The file appears whole or not at all.
///
/// JSON holds all that is seen of a scene, to the bit, and what goes with its camera, unless that
/// has been moved where JSON has no word for it; but not which triangles make up a flat polygon. Of
/// what the others have no word for, shapes are refused, and the rest is left out. That, and what
/// programs make of the rest that is not what raylane makes of it, is returned, in words.
///
/// Throws BadInput for another ending, for a shape that the format does not have or solids that are
/// nested deeper than raylane reads them, and SystemRefused.
std::vector<std::string> export_scene(const std::filesystem::path& path, const core::Scene& scene);

/// Throws BadInput for an ending that export_scene does not know.
void require_scene_ending(const std::filesystem::path& path);

} // namespace raylane::scenes
