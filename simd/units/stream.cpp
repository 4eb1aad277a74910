#include "simd/kernel/stream/stream.hpp"

#include "simd/kernel/traverse/prepare.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

template <Isa isa>
int KernelParts<isa>::lanes() {
    return static_cast<int>(Floats<ArchOf<isa>>::size);
}
template int KernelParts<Isa::RAYLANE_ISA>::lanes();

template <Isa isa>
RayKernels KernelParts<isa>::rays() {
    return Prepare<ArchOf<isa>>::table();
}
template RayKernels KernelParts<Isa::RAYLANE_ISA>::rays();

template <Isa isa>
StreamKernels KernelParts<isa>::stream() {
    return CallerStream<ArchOf<isa>>::table();
}
template StreamKernels KernelParts<Isa::RAYLANE_ISA>::stream();

} // namespace raylane::simd
