#include "simd/kernel/shade/shade.hpp"

#include "simd/units/kernels.hpp"

namespace raylane::simd {

template <Isa isa>
ShadeKernels KernelParts<isa>::shade(bool media, bool fog) {
    using Lanes = Double<ArchOf<isa>>;
    if (media)
        return fog ? Shading<Lanes, true, true>::table() : Shading<Lanes, true, false>::table();
    return fog ? Shading<Lanes, false, true>::table() : Shading<Lanes, false, false>::table();
}
template ShadeKernels KernelParts<Isa::RAYLANE_ISA>::shade(bool, bool);

} // namespace raylane::simd
