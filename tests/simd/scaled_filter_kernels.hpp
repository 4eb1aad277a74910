#pragma once

#include "simd/kernel/lanes/doubles.hpp"
#include "simd/kernel/shapes/crossings.hpp"
#include "simd/scene_view.hpp"
#include "tests/simd/scaled_filters.hpp"

// The filters' own headers, in a namespace beside the true one.
namespace raylane::scaled_simd {
using namespace raylane::simd;
}
#define simd scaled_simd

// All that filter.hpp says of half_ulp is its declaration, which this makes one of a variable.
#define half_ulp                                                                                   \
    true_half_ulp = 0x1p-24F;                                                                      \
    static float half_ulp
#include "simd/kernel/shapes/filter.hpp"
#undef half_ulp

#include "tests/simd/filter_kernels.hpp"
#undef simd

namespace raylane::scaled_simd {

template <class Arch>
ScaledFilters scaled_filters() {
    return {FilterChecksOf<Arch>::table(), &half_ulp};
}

} // namespace raylane::scaled_simd
