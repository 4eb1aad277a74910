#include "core/transfer.hpp"
#include "tests/catch.hpp"

#include <limits>

using namespace raylane::core;

TEST_CASE("transfer to 8 bits clamps and rounds to the nearest code") {
    CHECK(encode(0.0F, Transfer::linear) == 0);
    CHECK(encode(1.0F, Transfer::linear) == 255);
    CHECK(encode(-3.0F, Transfer::linear) == 0);
    CHECK(encode(7.0F, Transfer::srgb) == 255);
    CHECK(encode(std::numeric_limits<float>::quiet_NaN(), Transfer::srgb) == 0);
    CHECK(encode(std::numeric_limits<float>::infinity(), Transfer::srgb) == 255);
    CHECK(encode(100.4F / 255.0F, Transfer::linear) == 100);
    CHECK(encode(100.6F / 255.0F, Transfer::linear) == 101);
}

TEST_CASE("the sRGB curve passes through its known points") {
    CHECK(encode(0.2158605F, Transfer::srgb) == 128); // half of the codes
    CHECK(encode(0.0031308F, Transfer::srgb) == 10);  // where the straight part ends: 0.04045
    CHECK(encode(0.18F, Transfer::srgb) == 118);      // photographers' middle grey
}
