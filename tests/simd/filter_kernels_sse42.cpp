#include "tests/simd/filter_kernels.hpp"

raylane::simd::FilterChecks raylane::simd::filter_checks_sse42() {
    return FilterChecksOf<Sse42>::table();
}
