#pragma once

#include "core/scene/region.hpp"
#include "simd/threads.hpp"

#include <functional>

namespace raylane::simd {

/// Calls visit(region) once for each tile of a part of a picture, `tile` pixels on a side, on
/// `threads` threads (0: default_threads()). An exception ends the loop and comes out of it.
void for_each_tile(const core::Region& part, int tile, int threads,
                   const std::function<void(const core::Region&)>& visit);

} // namespace raylane::simd
