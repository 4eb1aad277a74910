#pragma once

#include "simd/kernels.hpp"

#include <cstdint>
#include <string_view>

namespace raylane::simd {

inline constexpr Isa all_isas[] = {Isa::portable, Isa::sse42, Isa::avx2, Isa::avx512, Isa::neon};

/// True if this program has kernels for it (RAYLANE_ISAS).
bool is_built(Isa isa);

/// True if it is built, and this processor and the system on it can run it. portable runs on any.
/// avx2 stands for AVX2 and FMA, avx512 for the F, CD, BW, DQ and VL parts. Every AArch64 processor
/// has neon. In WebAssembly, sse42 stands for its SIMD.
bool is_available(Isa isa);

/// The widest that is available. Throws std::runtime_error if none is.
Isa best_isa();

/// The first of all_isas that is available: others are compared with it. Throws as best_isa().
Isa narrowest_isa();

/// Name for people.
inline constexpr std::string_view name_of(Isa isa) {
    constexpr std::string_view names[] = {"portable", "sse4.2", "avx2", "avx512", "neon"};
    return names[static_cast<std::size_t>(isa)];
}

/// Undefined unless it is available.
const Kernels& kernels_of(Isa isa);

} // namespace raylane::simd
