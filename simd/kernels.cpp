#include "simd/kernels.hpp"

#include "simd/isa.hpp"

namespace raylane::simd {

const Kernels& kernels_of([[maybe_unused]] Isa isa) {
#ifdef __x86_64__
    switch (isa) {
    case Isa::portable:
    case Isa::neon:
        break;
    case Isa::sse42:
        return kernels_sse42();
    case Isa::avx2:
        return kernels_avx2();
    case Isa::avx512:
        return kernels_avx512();
    }
#elif defined(__wasm__)
    if (isa == Isa::sse42) return kernels_sse42();
#elif defined(__aarch64__)
    if (isa == Isa::neon) return kernels_neon();
#endif
    return kernels_portable();
}

} // namespace raylane::simd
