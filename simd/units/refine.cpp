#include "simd/kernel/certify/refine.hpp"

#include "simd/kernel/certify/cross_all.hpp"
#include "simd/kernel/certify/exact.hpp"
#include "simd/kernel/certify/first_surface.hpp"
#include "simd/kernel/certify/list_candidates.hpp"
#include "simd/kernel/traverse/in_flight/all.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

template <Isa isa>
RefineKernels KernelParts<isa>::refine() {
    using Arch = ArchOf<isa>;
    return {ListCandidates<Arch, ExactMethod<Arch>>::list,
            simd::refine<Arch>,
            widen<Arch>,
            InFlightAll<Arch, ExactMethod<Arch>>::list,
            cross_all<Arch>,
            simd::first_surfaces<Arch>};
}
template RefineKernels KernelParts<Isa::RAYLANE_ISA>::refine();

} // namespace raylane::simd
