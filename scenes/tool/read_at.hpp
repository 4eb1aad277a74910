#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace raylane::scenes {

/// Fills `bytes` from a position in a file on, as far as the file goes, and returns the number of
/// bytes. If there are fewer, errno is 0 at the end of the file, otherwise the system's error.
/// Thread-safe.
std::size_t read_at(int descriptor, std::int64_t place, std::span<char> bytes);

} // namespace raylane::scenes
