#pragma once

#include "simd/by_isa.hpp"
#include "simd/isa.hpp"
#include "simd/kernels.hpp"

namespace raylane::simd {

/// The kernels that solve crossings for `exact`. The search kernels take a minute to compile.
struct FinishKernels {
    decltype(MethodKernels::finish) finish;
    RefineKernels refine;
};

inline FinishKernels finish_kernels_of(Isa isa) {
    return of_isa(isa, []<Isa which>() {
        return FinishKernels{KernelParts<which>::finish(), KernelParts<which>::refine()};
    });
}

} // namespace raylane::simd
