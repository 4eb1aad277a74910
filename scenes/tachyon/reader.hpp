#pragma once

#include "core/scene/scene.hpp"
#include "scenes/input_file.hpp"
#include "scenes/tachyon/shading.hpp"

namespace raylane::scenes {

/// Reads a scene of Tachyon 0.99 (Stone, "Tachyon Parallel / Multiprocessor Ray Tracing System"),
/// as VMD and others write it. What it has and a scene here does not is drawn as nearly as may be,
/// and `on_remark` is told, once for each such thing: images, patterns and outlines are left out,
/// gradients, spotlights and fog that is squared are simpler, MEDIUM has shadows. Tachyon's
/// left-handed axes have become right-handed ones (TachyonWords); its colours are the picture's
/// codes, so that the transfer is linear.
/// `over` is in place of what the scene says. `workers` build the hierarchy, if there are any.
/// Throws BadInput, with the line, and SystemRefused.
core::Scene read_tachyon(InputFile& file, core::Workers* workers = nullptr,
                         const OnRemark& on_remark = {}, const TachyonShading& over = {});

} // namespace raylane::scenes
