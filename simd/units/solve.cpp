#include "simd/kernel/certify/solve.hpp"

#include "simd/kernel/shapes/shapes.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

template <Isa isa>
decltype(MethodKernels::solve) KernelParts<isa>::solve() {
    return simd::solve<ArchOf<isa>, Wanted::crossings>;
}
template decltype(MethodKernels::solve) KernelParts<Isa::RAYLANE_ISA>::solve();

template <Isa isa>
decltype(MethodKernels::solve) KernelParts<isa>::solve_all() {
    return simd::solve<ArchOf<isa>, Wanted::all>;
}
template decltype(MethodKernels::solve) KernelParts<Isa::RAYLANE_ISA>::solve_all();

} // namespace raylane::simd
