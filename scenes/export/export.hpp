#pragma once

#include "core/scene/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace raylane::scenes {

/// Writes a scene in the format that the file's ending selects, in any case: .json (raylane's own),
/// .nff (of the Standard Procedural Databases), .pov (POV-Ray 3.7's), or .rl (the in-memory layout,
/// see scenes/formats/built). The file appears complete or not at all.
///
/// JSON keeps everything visible of a scene, to the bit, and the automatic camera, unless that
/// has been changed to something that JSON cannot express. It loses which triangles make up a flat
/// polygon. The other formats refuse shapes that they cannot express, and omit other features that
/// they cannot express. Returns a phrase for each omitted feature, and for each feature that other
/// programs interpret differently from raylane.
///
/// Throws BadInput for another ending, for a shape that the format lacks, and for solids that are
/// nested deeper than raylane reads them. Throws SystemRefused.
std::vector<std::string> export_scene(const std::filesystem::path& path, const core::Scene& scene);

/// Throws BadInput if export_scene() does not know the ending.
void require_scene_ending(const std::filesystem::path& path);

} // namespace raylane::scenes
