#pragma once

#include <cstdint>

namespace raylane::simd {

/// An instruction set, as far as kernels use it.
enum class Isa : std::uint8_t { portable, sse42, avx2, avx512, neon };

} // namespace raylane::simd
