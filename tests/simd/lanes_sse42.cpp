#include "tests/simd/lanes_check.hpp"

int raylane::simd::lanes_failures_sse42() {
    return LanesCheck<Sse42>::failures();
}
