#include "simd/kernel/kernels.hpp"

namespace raylane::simd {

const Kernels& kernels_avx2() {
    static constexpr Kernels kernels = KernelsOf<Avx2>::table("avx2");
    return kernels;
}

} // namespace raylane::simd
