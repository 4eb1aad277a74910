#include "tests/simd/bounded_lanes.hpp"
#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

int raylane::simd::lanes_failures_avx512() {
    return LanesCheck<Avx512>::failures();
}

int raylane::simd::queue_failures_avx512() {
    return queue_failures<Avx512>();
}

int raylane::simd::bounded_operation_avx512(int operation, const BoundedColumns& a,
                                            const BoundedColumns& b, BoundedColumns& result) {
    return bounded_operation<Avx512>(operation, a, b, result);
}
