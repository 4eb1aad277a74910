#include "tests/simd/scaled_filter_kernels.hpp"

raylane::simd::ScaledFilters raylane::simd::scaled_filters_neon() {
    return scaled_simd::scaled_filters<Neon>();
}
