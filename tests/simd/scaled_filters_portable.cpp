#include "tests/simd/scaled_filter_kernels.hpp"

raylane::simd::ScaledFilters raylane::simd::scaled_filters_portable() {
    return scaled_simd::scaled_filters<Portable>();
}
