#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

int raylane::simd::lanes_failures_avx2() {
    return LanesCheck<Avx2>::failures();
}

int raylane::simd::queue_failures_avx2() {
    return queue_failures<Avx2>();
}
