#include "tests/simd/lanes_check.hpp"

int raylane::simd::lanes_failures_avx512() {
    return LanesCheck<Avx512>::failures();
}
