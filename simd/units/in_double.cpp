#include "simd/kernel/certify/in_double.hpp"

#include "simd/kernel/traverse/one_way.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

template <Isa isa>
MethodKernels KernelParts<isa>::in_double() {
    return OneWay<ArchOf<isa>, DoubleMethod<ArchOf<isa>>>::kernels();
}
template MethodKernels KernelParts<Isa::RAYLANE_ISA>::in_double();

} // namespace raylane::simd
