#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace raylane::scenes {

/// Fills `bytes` from a place in a file on, as far as that goes, and returns how many there were.
/// If these are fewer, errno is 0 at the file's end, and else what the system said. By any number
/// of threads at a time.
std::size_t read_at(int descriptor, std::int64_t place, std::span<char> bytes);

} // namespace raylane::scenes
