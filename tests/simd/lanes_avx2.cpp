#include "tests/simd/lanes_check.hpp"

int raylane::simd::lanes_failures_avx2() {
    return LanesCheck<Avx2>::failures();
}
