#include "tests/simd/bounded_lanes.hpp"
#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

int raylane::simd::lanes_failures_portable() {
    return LanesCheck<Portable>::failures();
}

int raylane::simd::queue_failures_portable() {
    return queue_failures<Portable>();
}

int raylane::simd::bounded_operation_portable(int operation, const BoundedColumns& a,
                                              const BoundedColumns& b, BoundedColumns& result) {
    return bounded_operation<Portable>(operation, a, b, result);
}
