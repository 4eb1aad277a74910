#pragma once

#include "core/scene/scene.hpp"
#include "scenes/input_file.hpp"

namespace raylane::scenes {

/// Reads what of POV-Ray's scene language programs write that draw atoms and the like, and people
/// by hand: all of its directives but of files and #switch, its numbers, vectors and colours, and
/// of its objects those that are made of quadrics and triangles. `on_remark` is told what is drawn
/// another way than there. A picture has the camera's ratio of width to height, and is 640 pixels
/// along its larger side, or as large as a remark at the file's beginning says: "+W512 +H512".
///
/// Where the camera sees the world as in a mirror, as POV-Ray's own does by default, z is turned
/// against z.
///
/// Throws BadInput, with line and column, and SystemRefused.
core::Scene read_pov(InputFile& file, core::Workers* workers, const OnRemark& on_remark);

} // namespace raylane::scenes
