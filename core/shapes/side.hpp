#pragma once

#include <cstdint>

namespace raylane::core {

/// The side of a solid on which a point is.
enum class Side : std::int8_t { inside = -1, surface = 0, outside = 1 };

} // namespace raylane::core
