#include "simd/isa.hpp"
#include "tests/catch.hpp"
#include "tests/simd/lanes_check.hpp"
#include "tests/simd/queue_check.hpp"

using namespace raylane::simd;

TEST_CASE("lanes do what loops over numbers do") {
    CHECK(lanes_failures_portable() == 0);
    if (is_available(Isa::sse42)) CHECK(lanes_failures_sse42() == 0);
    if (is_available(Isa::avx2)) CHECK(lanes_failures_avx2() == 0);
    if (is_available(Isa::avx512)) CHECK(lanes_failures_avx512() == 0);
}

TEST_CASE("a queue has room for all that a ray may enter, and loses none of it") {
    CHECK(queue_failures_portable() == 0);
    if (is_available(Isa::sse42)) CHECK(queue_failures_sse42() == 0);
    if (is_available(Isa::avx2)) CHECK(queue_failures_avx2() == 0);
    if (is_available(Isa::avx512)) CHECK(queue_failures_avx512() == 0);
}
