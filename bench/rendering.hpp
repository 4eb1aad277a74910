#pragma once

#include "core/scene/scene.hpp"
#include "simd/wavefront/render.hpp"

#include <functional>
#include <memory>
#include <string>

namespace raylane::bench {

/// Makes a scene at the first request. The scene is kept only while it is measured.
using MakeScene = std::function<std::shared_ptr<const core::Scene>()>;

/// Registers NAME/avx512 and so on for all instruction sets that this processor has, and
/// NAME/reference_float and NAME/reference_double: images of the scene with its settings, on one
/// thread. `seconds` is wall time per image, `per_primary` the time per sample with everything that
/// follows from it; rays are counted per image.
void add_renderings(const std::string& name, const MakeScene& make_scene);

} // namespace raylane::bench
