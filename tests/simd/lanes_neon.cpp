#include "tests/simd/bounded_lanes.hpp"
#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

int raylane::simd::lanes_failures_neon() {
    return LanesCheck<Neon>::failures();
}

int raylane::simd::queue_failures_neon() {
    return queue_failures<Neon>();
}

int raylane::simd::bounded_operation_neon(int operation, const BoundedColumns& a,
                                          const BoundedColumns& b, BoundedColumns& result) {
    return bounded_operation<Neon>(operation, a, b, result);
}
