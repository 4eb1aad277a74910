#pragma once

#include <cstdint>

namespace raylane::core {

/// Which side of a solid a point is on.
enum class Side : std::int8_t { inside = -1, surface = 0, outside = 1 };

} // namespace raylane::core
