#pragma once

#include "simd/isa.hpp"

#include <array>
#include <cstddef>
#include <utility>

/// Functions of units that are compiled once for each instruction set (raylane_kernel_units).
namespace raylane::simd {

/// std::array of {instruction set, NAME_portable} and so on: those that this kind of processor has.
#define RAYLANE_UNIT(name, isa) std::make_pair(raylane::simd::Isa::isa, name##_##isa)
#if defined(__x86_64__)
#define RAYLANE_BY_ISA(name)                                                                       \
    std::array {                                                                                   \
        RAYLANE_UNIT(name, portable), RAYLANE_UNIT(name, sse42), RAYLANE_UNIT(name, avx2),         \
            RAYLANE_UNIT(name, avx512)                                                             \
    }
#elif defined(__wasm__)
#define RAYLANE_BY_ISA(name)                                                                       \
    std::array {                                                                                   \
        RAYLANE_UNIT(name, portable), RAYLANE_UNIT(name, sse42)                                    \
    }
#elif defined(__aarch64__)
#define RAYLANE_BY_ISA(name)                                                                       \
    std::array {                                                                                   \
        RAYLANE_UNIT(name, portable), RAYLANE_UNIT(name, neon)                                     \
    }
#else
#define RAYLANE_BY_ISA(name)                                                                       \
    std::array {                                                                                   \
        RAYLANE_UNIT(name, portable)                                                               \
    }
#endif

template <class Function, std::size_t count>
Function of_isa(Isa isa, const std::array<std::pair<Isa, Function>, count>& all) {
    for (const auto& [its, function] : all)
        if (its == isa) return function;
    return nullptr;
}

} // namespace raylane::simd
