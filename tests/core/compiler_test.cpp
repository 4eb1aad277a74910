#include "tests/catch.hpp"
#include "tests/core/rounded_pair.hpp"

/// What compilers are known to get wrong, and flags keep them from.

TEST_CASE("a double that was rounded to float stays so") {
    const double exact[] = {1.0 / 3.0, 1.0 / 7.0};
    float rounded[2];
    double widened[2];
    raylane::tests::round_and_widen(exact, rounded, widened);
    CHECK(widened[0] == 0x1.555556p-2);
    CHECK(widened[1] == 0x1.24924ap-3);
    CHECK(rounded[0] == 0x1.555556p-2F);
}
