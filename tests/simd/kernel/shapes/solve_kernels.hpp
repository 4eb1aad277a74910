#pragma once

#include "simd/isa/by_isa.hpp"
#include "simd/isa/isa.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

/// The kernels that solve crossings for `exact`. The search kernels take a minute to compile.
struct SolveKernels {
    decltype(MethodKernels::solve) solve;
    RefineKernels refine;
};

inline SolveKernels solve_kernels_of(Isa isa) {
    return of_isa(isa, []<Isa which>() {
        return SolveKernels{KernelParts<which>::solve(), KernelParts<which>::refine()};
    });
}

} // namespace raylane::simd
