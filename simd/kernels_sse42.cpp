#include "simd/kernel/kernels.hpp"

namespace raylane::simd {

const Kernels& kernels_sse42() {
    static constexpr Kernels kernels = KernelsOf<Sse42>::table("sse4.2");
    return kernels;
}

} // namespace raylane::simd
