#pragma once

#include "core/scene/scene.hpp"
#include "simd/render.hpp"

#include <functional>
#include <memory>
#include <string>

namespace raylane::bench {

/// Made when first asked for, and no longer kept than somebody measures it.
using MakeScene = std::function<std::shared_ptr<const core::Scene>()>;

/// Registers NAME/avx512 and so on for all instruction sets that this processor has, and
/// NAME/reference_float and NAME/reference_double: pictures of the scene as its settings want it,
/// by one thread. `seconds` is wall time per picture, `per_primary` time per sample with all that
/// follows from it; rays are counted per picture.
void add_renderings(const std::string& name, const MakeScene& make_scene);

} // namespace raylane::bench
