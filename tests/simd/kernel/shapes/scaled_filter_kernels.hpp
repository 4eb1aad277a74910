#pragma once

#include "simd/kernel/lanes/bounded.hpp"
#include "simd/kernel/shapes/crossings.hpp"
#include "simd/units/scene_view.hpp"
#include "tests/simd/kernel/shapes/scaled_filters.hpp"

// Includes the filters' headers in another namespace.
namespace raylane::scaled_simd {
using namespace raylane::simd;
}
#define simd scaled_simd

// In filter.hpp, half_ulp occurs only in its declaration, which this turns into that of a variable.
#define half_ulp                                                                                   \
    true_half_ulp = 0x1p-24F;                                                                      \
    static float half_ulp
#include "simd/kernel/shapes/filter.hpp"
#undef half_ulp

#include "tests/simd/kernel/shapes/filter_kernels.hpp"
#undef simd

namespace raylane::scaled_simd {

template <class Arch>
ScaledFilters scaled_filters() {
    return {FilterChecksOf<Arch>::table(), &half_ulp};
}

} // namespace raylane::scaled_simd
