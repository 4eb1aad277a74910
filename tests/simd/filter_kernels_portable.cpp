#include "tests/simd/filter_kernels.hpp"

raylane::simd::FilterChecks raylane::simd::filter_checks_portable() {
    return FilterChecksOf<Portable>::table();
}
