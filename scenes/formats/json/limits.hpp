#pragma once

#include <cstddef>

namespace raylane::scenes {

/// The most levels of objects and lists in an object of a scene, for readers and writers.
inline constexpr std::size_t max_levels = 256;

} // namespace raylane::scenes
