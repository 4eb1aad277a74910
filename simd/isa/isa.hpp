#pragma once

#include "simd/units/kernels.hpp"

#include <cstddef>
#include <span>
#include <string_view>

namespace raylane::simd {

inline constexpr Isa all_isas[] = {Isa::portable, Isa::sse42, Isa::avx2, Isa::avx512, Isa::neon};

/// Returns true if this program has kernels for `isa` (RAYLANE_ISAS).
bool is_built(Isa isa);

/// Returns true if `isa` is built and both the processor and the operating system can run it.
/// portable runs on any. avx2 stands for AVX2 and FMA, avx512 for the F, CD, BW, DQ and VL parts.
/// Every AArch64 processor has neon. In WebAssembly, sse42 stands for WebAssembly SIMD.
bool is_available(Isa isa);

/// Returns the available ones of all_isas, at least one. Throws std::runtime_error if none is
/// available.
std::span<const Isa> available_isas();

/// Returns the widest available instruction set. Throws the same.
inline Isa best_isa() {
    return available_isas().back();
}

/// Returns the first available one, with which the others are compared. Throws the same.
inline Isa narrowest_isa() {
    return available_isas().front();
}

/// Returns core::Workers::node_width() for an instruction set: 16 for registers of 16 lanes,
/// otherwise 8.
inline constexpr int node_width_of(Isa isa) {
    return isa == Isa::avx512 ? 16 : 8;
}

/// Returns the one for the widest available instruction set.
inline int node_width() {
    return node_width_of(is_available(Isa::avx512) ? Isa::avx512 : Isa::avx2);
}

/// Returns the name that users see.
inline constexpr std::string_view name_of(Isa isa) {
    constexpr std::string_view names[] = {"portable", "sse4.2", "avx2", "avx512", "neon"};
    return names[static_cast<std::size_t>(isa)];
}

/// Returns the kernels of `isa`. Undefined unless `isa` is available.
const Kernels& kernels_of(Isa isa);

} // namespace raylane::simd
