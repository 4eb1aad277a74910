#include "simd/kernel/kernels.hpp"

namespace raylane::simd {

const Kernels& kernels_avx512() {
    static constexpr Kernels kernels = KernelsOf<Avx512>::table("avx512");
    return kernels;
}

} // namespace raylane::simd
