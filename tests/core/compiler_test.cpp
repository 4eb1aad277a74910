#include "core/numbers/vector.hpp"
#include "tests/core/rounded_pair.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

/// Known faults of compilers and libraries that our flags or code avoid.

TEST_CASE("a double that was rounded to float keeps the rounded value") {
    const double exact[] = {1.0 / 3.0, 1.0 / 7.0};
    float rounded[2];
    double widened[2];
    raylane::tests::round_and_widen(exact, rounded, widened);
    CHECK(widened[0] == 0x1.555556p-2);
    CHECK(widened[1] == 0x1.24924ap-3);
    CHECK(rounded[0] == 0x1.555556p-2F);
}

// GLM 1.0.2 subtracts from 0.
TEST_CASE("the negative of a vector negates every component including zeros") {
    const auto negative = -raylane::core::Vec3d(0.0, -0.0, 2.0);
    CHECK(std::signbit(negative.x));
    CHECK_FALSE(std::signbit(negative.y));
    CHECK(negative.z == -2.0);
}
