#include "simd/kernel/certify/plain.hpp"
#include "simd/kernel/traverse/one_way.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

template <Isa isa>
MethodKernels KernelParts<isa>::in_float(bool textbook) {
    using Arch = ArchOf<isa>;
    return textbook ? OneWay<Arch, PlainMethod<Arch, true>>::kernels()
                    : OneWay<Arch, PlainMethod<Arch, false>>::kernels();
}
template MethodKernels KernelParts<Isa::RAYLANE_ISA>::in_float(bool);

} // namespace raylane::simd
