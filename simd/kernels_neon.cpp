#include "simd/kernel/kernels.hpp"

namespace raylane::simd {

const Kernels& kernels_neon() {
    static constexpr Kernels kernels = KernelsOf<Neon>::table("neon");
    return kernels;
}

} // namespace raylane::simd
