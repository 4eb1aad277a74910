#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

int raylane::simd::lanes_failures_sse42() {
    return LanesCheck<Sse42>::failures();
}

int raylane::simd::queue_failures_sse42() {
    return queue_failures<Sse42>();
}
