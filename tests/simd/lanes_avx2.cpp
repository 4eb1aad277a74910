#include "tests/simd/bounded_lanes.hpp"
#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

int raylane::simd::lanes_failures_avx2() {
    return LanesCheck<Avx2>::failures();
}

int raylane::simd::queue_failures_avx2() {
    return queue_failures<Avx2>();
}

int raylane::simd::bounded_operation_avx2(int operation, const BoundedColumns& a,
                                          const BoundedColumns& b, BoundedColumns& result) {
    return bounded_operation<Avx2>(operation, a, b, result);
}
