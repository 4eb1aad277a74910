#include "simd/isa.hpp"

#include <algorithm>
#include <iterator>

namespace raylane::simd {

bool is_available(Isa isa) {
#ifdef __x86_64__
    switch (isa) {
    case Isa::portable:
        return true;
    case Isa::sse42:
        return __builtin_cpu_supports("sse4.2") != 0;
    case Isa::avx2:
        return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
    case Isa::neon:
        return false;
    case Isa::avx512:
        break;
    }
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
           __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0;
#elif defined(__wasm__)
    return isa == Isa::portable || isa == Isa::sse42; // what engines without do not load
#elif defined(__aarch64__)
    return isa == Isa::portable || isa == Isa::neon;
#else
    return isa == Isa::portable;
#endif
}

Isa best_isa() {
    return *std::find_if(std::rbegin(all_isas), std::rend(all_isas), is_available);
}

} // namespace raylane::simd
