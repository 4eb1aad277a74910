#pragma once

#include "tests/simd/kernel/shapes/filter_check.hpp"

/// The filters with a variable allowance for rounding, so that a test can find how much of it a ray
/// needs.
namespace raylane::simd {

struct ScaledFilters {
    FilterChecks checks;
    float* half_ulp; ///< the constant that the filters of this instruction set use
};

/// Defined in the kernel unit of each instruction set.
template <Isa isa>
ScaledFilters scaled_filters();

} // namespace raylane::simd
