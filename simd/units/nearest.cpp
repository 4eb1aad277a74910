#include "simd/kernel/certify/exact.hpp"
#include "simd/kernel/traverse/traverse.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

template <Isa isa>
decltype(TraceKernels::nearest) KernelParts<isa>::nearest() {
    return Trace<ArchOf<isa>, ExactMethod<ArchOf<isa>>>::nearest;
}
template decltype(TraceKernels::nearest) KernelParts<Isa::RAYLANE_ISA>::nearest();

} // namespace raylane::simd
