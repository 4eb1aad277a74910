#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

int raylane::simd::lanes_failures_portable() {
    return LanesCheck<Portable>::failures();
}

int raylane::simd::queue_failures_portable() {
    return queue_failures<Portable>();
}
