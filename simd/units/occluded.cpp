#include "simd/kernel/certify/exact.hpp"
#include "simd/kernel/traverse/traverse.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

template <Isa isa>
decltype(TraceKernels::occluded) KernelParts<isa>::occluded() {
    return Trace<ArchOf<isa>, ExactMethod<ArchOf<isa>>>::occluded;
}
template decltype(TraceKernels::occluded) KernelParts<Isa::RAYLANE_ISA>::occluded();

} // namespace raylane::simd
