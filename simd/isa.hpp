#pragma once

#include "simd/kernels.hpp"

#include <string_view>

namespace raylane::simd {

inline constexpr Isa all_isas[] = {Isa::portable, Isa::sse42, Isa::avx2, Isa::avx512, Isa::neon};

/// Returns true if this program has kernels for `isa` (RAYLANE_ISAS).
bool is_built(Isa isa);

/// Returns true if `isa` is built and both the processor and the operating system can run it.
/// portable runs on any. avx2 stands for AVX2 and FMA, avx512 for the F, CD, BW, DQ and VL parts.
/// Every AArch64 processor has neon. In WebAssembly, sse42 stands for WebAssembly SIMD.
bool is_available(Isa isa);

/// Returns the widest available instruction set. Throws std::runtime_error if none is available.
Isa best_isa();

/// Returns the first available one of all_isas, with which the others are compared. Throws as
/// best_isa().
Isa narrowest_isa();

/// Returns the name that users see.
inline constexpr std::string_view name_of(Isa isa) {
    constexpr std::string_view names[] = {"portable", "sse4.2", "avx2", "avx512", "neon"};
    return names[static_cast<std::size_t>(isa)];
}

/// Returns the kernels of `isa`. Undefined unless `isa` is available.
const Kernels& kernels_of(Isa isa);

} // namespace raylane::simd
