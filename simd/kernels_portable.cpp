#include "simd/kernel/kernels.hpp"

namespace raylane::simd {

const Kernels& kernels_portable() {
    static constexpr Kernels kernels = KernelsOf<Portable>::table("portable");
    return kernels;
}

} // namespace raylane::simd
