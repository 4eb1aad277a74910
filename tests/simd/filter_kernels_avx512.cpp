#include "tests/simd/filter_kernels.hpp"

raylane::simd::FilterChecks raylane::simd::filter_checks_avx512() {
    return FilterChecksOf<Avx512>::table();
}
