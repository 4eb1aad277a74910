#include "tests/simd/filter_kernels.hpp"

raylane::simd::FilterChecks raylane::simd::filter_checks_neon() {
    return FilterChecksOf<Neon>::table();
}
