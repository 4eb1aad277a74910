#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

int raylane::simd::lanes_failures_avx512() {
    return LanesCheck<Avx512>::failures();
}

int raylane::simd::queue_failures_avx512() {
    return queue_failures<Avx512>();
}
