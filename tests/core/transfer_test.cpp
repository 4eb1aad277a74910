#include "core/scene/transfer.hpp"
#include "tests/support/catch.hpp"

#include <bit>
#include <cstdint>
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

TEST_CASE("transfer to 16 bits clamps and rounds to the nearest code") {
    for (const Transfer transfer : {Transfer::linear, Transfer::srgb}) {
        CHECK(encode_in_16_bits(0.0F, transfer) == 0);
        CHECK(encode_in_16_bits(-1.0F, transfer) == 0);
        CHECK(encode_in_16_bits(std::numeric_limits<float>::quiet_NaN(), transfer) == 0);
        CHECK(encode_in_16_bits(1.0F, transfer) == 65535);
        CHECK(encode_in_16_bits(std::numeric_limits<float>::infinity(), transfer) == 65535);
    }
    CHECK(encode_in_16_bits(100.4F / 65535.0F, Transfer::linear) == 100);
    CHECK(encode_in_16_bits(100.6F / 65535.0F, Transfer::linear) == 101);
    CHECK(encode_in_16_bits(0.2158605F, Transfer::srgb) == 32896); // 128 of 255
}

TEST_CASE("the sRGB curve passes through its known points") {
    CHECK(encode(0.2158605F, Transfer::srgb) == 128); // half of the codes
    CHECK(encode(0.0031308F, Transfer::srgb) == 10);  // where the straight part ends: 0.04045
    CHECK(encode(0.18F, Transfer::srgb) == 118);      // photographers' middle grey
}

TEST_CASE("codes from the table are the computed codes") {
    for (const Transfer transfer : {Transfer::linear, Transfer::srgb}) {
        const Encoder look_up(transfer);
        std::uint32_t wrong = 0, last = 0;
        const auto check = [&](std::uint32_t bits) {
            const float value = std::bit_cast<float>(bits);
            wrong += look_up(value) != encode(value, transfer) ? 1 : 0;
        };
        // Every 500th float from 0 to above 1, and all floats near each step of the curve.
        for (std::uint32_t bits = 0; bits < std::bit_cast<std::uint32_t>(1.01F); bits += 500) {
            check(bits);
            const std::uint8_t code = encode(std::bit_cast<float>(bits), transfer);
            if (code != last)
                for (std::uint32_t near = bits - 502; near < bits + 2; ++near)
                    check(near);
            last = code;
        }
        CHECK(wrong == 0);
        for (const float odd : {-1.0F, -0.0F, 7.0F, std::numeric_limits<float>::quiet_NaN(),
                                std::numeric_limits<float>::infinity()})
            CHECK(look_up(odd) == encode(odd, transfer));
    }
}
