#pragma once

#include <cstdint>

namespace raylane::core {

/// Returns the hash of a value behind others with the hash `hash`.
inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9E3779B97F4A7C15;
    return hash ^ hash >> 32;
}

} // namespace raylane::core
