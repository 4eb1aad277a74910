#pragma once

#include "simd/isa/isa_name.hpp"

namespace raylane::simd {

/// Returns true if both this processor and its operating system can run an instruction set.
inline bool processor_runs(Isa isa) {
    if (isa == Isa::portable) return true;
#ifdef __x86_64__
    switch (isa) {
    case Isa::sse42:
        return __builtin_cpu_supports("sse4.2") != 0;
    case Isa::avx2:
        return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
    case Isa::avx512:
        return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
               __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
               __builtin_cpu_supports("avx512vl") != 0;
    case Isa::portable:
    case Isa::neon:
        break;
    }
    return false;
#elif defined(__wasm__)
    return isa == Isa::sse42; // engines without SIMD do not load the module
#elif defined(__aarch64__)
    return isa == Isa::neon;
#else
    return false;
#endif
}

} // namespace raylane::simd
