#pragma once

#include "core/surroundings.hpp"

#include <cstdint>

namespace raylane::core {

/// The 8-bit code of a linear component, which is clamped to [0, 1] first; NaN gives 0.
/// srgb: the curve of IEC 61966-2-1. Rounded to the nearest code.
std::uint8_t encode(float linear, Transfer transfer);

} // namespace raylane::core
