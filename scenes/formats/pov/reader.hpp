#pragma once

#include "core/scene/scene.hpp"
#include "scenes/files/input_file.hpp"

namespace raylane::scenes {

/// Reads the parts of POV-Ray's scene language that are written by programs that render atoms and
/// the like, and by hand: all directives except reading and writing files, numbers, vectors and
/// colours, and objects that are made of quadrics and triangles. `on_remark` receives everything
/// that is rendered differently from POV-Ray. The image has the camera's ratio of width to height.
/// Its larger side has 640 pixels, unless a comment at the file's beginning gives a size: "+W512
/// +H512".
///
/// If the camera sees the world mirrored, as POV-Ray's default camera does, z is negated.
///
/// Throws BadInput, with line and column, and SystemRefused.
core::Scene read_pov(InputFile& file, core::Workers* workers, const OnRemark& on_remark);

} // namespace raylane::scenes
