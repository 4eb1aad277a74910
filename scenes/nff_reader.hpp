#pragma once

#include "core/scene.hpp"
#include "scenes/input_file.hpp"

namespace raylane::scenes {

/// Reads a scene in the Neutral File Format (Haines, "A Proposal for Standard Graphics
/// Environments", 1987), version 3.1: v, b, l, f, s, c, p, pp and comments. Throws BadInput, whose
/// place is "line N".
core::Scene read_nff(InputFile& file);

} // namespace raylane::scenes
