#pragma once

#include "tests/simd/filter_check.hpp"

/// The filters, with what they allow for rounding as a variable: so a test can ask how much of it a
/// ray needs.
namespace raylane::simd {

struct ScaledFilters {
    FilterChecks checks;
    float* half_ulp; ///< the constant that the filters of this instruction set use
};

/// Defined in the kernel unit of each instruction set.
template <Isa isa>
ScaledFilters scaled_filters();

} // namespace raylane::simd
