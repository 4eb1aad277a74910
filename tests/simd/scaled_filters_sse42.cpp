#include "tests/simd/scaled_filter_kernels.hpp"

raylane::simd::ScaledFilters raylane::simd::scaled_filters_sse42() {
    return scaled_simd::scaled_filters<Sse42>();
}
