#pragma once

#include "core/scene/scene.hpp"
#include "scenes/files/input_file.hpp"

namespace raylane::scenes {

/// Reads a scene in the Neutral File Format (Haines, "A Proposal for Standard Graphics
/// Environments", 1987), version 3.1: v, b, l, f, s, c, p, pp and comments. Where its text leaves a
/// choice:
/// - the view's hither plane is not used; of several views or backgrounds the last counts;
/// - lights without a colour and the ambient light have the intensity sqrt(n) / 2n for n lights;
/// - opaque objects are visible from both sides, but only from inside if their radius is negative;
/// - objects before the first f are matte grey;
/// - Ks is also the reflected fraction; an index of refraction of 0 is read as 1 if T is 0.
///
/// `workers` build the hierarchy, if set. Throws BadInput, with the line, and SystemRefused.
core::Scene read_nff(InputFile& file, core::Workers* workers = nullptr,
                     const OnRemark& on_remark = {});

} // namespace raylane::scenes
