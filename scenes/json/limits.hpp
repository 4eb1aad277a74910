#pragma once

#include <cstddef>

namespace raylane::scenes {

/// Levels of objects and lists that an object of a scene may have, for those who read and write it.
inline constexpr std::size_t most_levels = 256;

} // namespace raylane::scenes
