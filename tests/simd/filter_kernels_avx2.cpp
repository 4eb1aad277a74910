#include "tests/simd/filter_kernels.hpp"

raylane::simd::FilterChecks raylane::simd::filter_checks_avx2() {
    return FilterChecksOf<Avx2>::table();
}
