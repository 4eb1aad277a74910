#include "simd/kernel/certify/finish.hpp"

#include "simd/kernel/shapes/shapes.hpp"
#include "simd/kernels.hpp"

namespace raylane::simd {

template <Isa isa>
decltype(MethodKernels::finish) KernelParts<isa>::finish() {
    return simd::finish<ArchOf<isa>, Wanted::crossings>;
}
template decltype(MethodKernels::finish) KernelParts<Isa::RAYLANE_ISA>::finish();

template <Isa isa>
decltype(MethodKernels::finish) KernelParts<isa>::finish_all() {
    return simd::finish<ArchOf<isa>, Wanted::all>;
}
template decltype(MethodKernels::finish) KernelParts<Isa::RAYLANE_ISA>::finish_all();

} // namespace raylane::simd
