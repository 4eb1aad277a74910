#include "tests/simd/bounded_lanes.hpp"
#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

int raylane::simd::lanes_failures_sse42() {
    return LanesCheck<Sse42>::failures();
}

int raylane::simd::queue_failures_sse42() {
    return queue_failures<Sse42>();
}

int raylane::simd::bounded_operation_sse42(int operation, const BoundedColumns& a,
                                           const BoundedColumns& b, BoundedColumns& result) {
    return bounded_operation<Sse42>(operation, a, b, result);
}
