#pragma once

#include "core/scene/scene.hpp"
#include "scenes/format.hpp"
#include "scenes/structure/drawing.hpp"

namespace raylane::scenes {

/// Reads the first frame of a file of atoms, and draws it. Throws BadInput, with the line, and
/// SystemRefused.
core::Scene read_structure(InputFile& file, Format format, const Drawing& drawing,
                           core::Workers* workers = nullptr);

} // namespace raylane::scenes
