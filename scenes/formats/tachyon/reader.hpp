#pragma once

#include "core/scene/scene.hpp"
#include "scenes/files/input_file.hpp"
#include "scenes/formats/tachyon/shading.hpp"

namespace raylane::scenes {

/// Reads a scene of Tachyon 0.99 (Stone, "Tachyon Parallel / Multiprocessor Ray Tracing System"),
/// as written by VMD and others. Unsupported features are approximated, with one call of
/// `on_remark` for each: images, patterns and outlines are omitted; gradients, spotlights and
/// squared fog are simplified; MEDIUM has shadows. Tachyon's left-handed axes become right-handed
/// (TachyonWords). Its colours are the codes of the image file, so the transfer is linear. `over`
/// overrides the scene's shading. `workers` build the hierarchy, if set. Throws BadInput, with the
/// line, and SystemRefused.
core::Scene read_tachyon(InputFile& file, core::Workers* workers = nullptr,
                         const OnRemark& on_remark = {}, const TachyonShading& over = {});

} // namespace raylane::scenes
