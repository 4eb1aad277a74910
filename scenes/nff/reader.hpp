#pragma once

#include "core/scene/scene.hpp"
#include "scenes/input_file.hpp"

namespace raylane::scenes {

/// Reads a scene in the Neutral File Format (Haines, "A Proposal for Standard Graphics
/// Environments", 1987), version 3.1: v, b, l, f, s, c, p, pp and comments. Where its text leaves a
/// choice:
/// - the view's hither plane is not used; of several views or backgrounds the last counts;
/// - lights without a colour and the ambient light have the intensity sqrt(n) / 2n for n lights;
/// - opaque objects are seen from both sides, but from inside alone where the radius is negative;
/// - objects before the first f are a matte grey;
/// - Ks is what is reflected as well; an index of refraction of 0 is 1 where T is 0.
/// `workers` build the hierarchy, if there are any.
/// Throws BadInput, with the line, and SystemRefused.
core::Scene read_nff(InputFile& file, core::Workers* workers = nullptr,
                     const OnRemark& on_remark = {});

} // namespace raylane::scenes
