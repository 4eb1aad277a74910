#pragma once

#include <cstdint>

namespace raylane::core {

/// An angle x as quadrant * pi/2 + (remainder + correction), with |remainder| <= pi/4 and the
/// correction below the remainder's last digit. The quadrant is an integer congruent to x's
/// quadrant modulo 4.
template <class Number>
struct ReducedAngle {
    Number quadrant;
    Number remainder;
    Number correction;
};

/// Returns the reduced angle of a finite x with |x| > 1, however large, with a relative error of
/// 2^-61 in remainder + correction. x is an integer times a power of two, so only 192 binary digits
/// of 2/pi decide its position within a turn: earlier digits count whole turns, later ones are too
/// small. No double is closer to a multiple of pi/2 than 2^-62. Source: Payne and Hanek, "Radian
/// reduction for trigonometric functions" (1983). `User` separates the instantiations of
/// compilation units that must not share one.
template <class User>
ReducedAngle<double> reduced_huge_angle(double x) {
    // Binary digits of 2/pi, preceded by 64 zeros before the binary point.
    static constexpr std::uint64_t digits[] = {
        0x0000000000000000, 0xA2F9836E4E441529, 0xFC2757D1F534DDC0, 0xDB6295993C439041,
        0xFE5163ABDEBBC561, 0xB7246E3A424DD2E0, 0x06492EEA09D1921C, 0xFE1DEB1CB129A73E,
        0xE88235F52EBB4484, 0xE99C7026B45F7E41, 0x3991D639835339F4, 0x9C845F8BBDF9283B,
        0x1FF897FFDE05980F, 0xEF2F118B5A0A6D1F, 0x6D367ECF27CB09B7, 0x4F463F669E5FEA2D,
        0x7527BAC7EBE5F17B, 0x3D0739F78A5292EA, 0x6BFB5FB11F8D5D08, 0x56033046FC7B6BAB};
    constexpr std::uint64_t half_pi = 0xC90FDAA22168C235; // times 2^63
    __extension__ using Wide = unsigned __int128;

    const auto bits = __builtin_bit_cast(std::uint64_t, x);
    const int exponent = static_cast<int>(bits >> 52 & 0x7FF) - 1075;
    const std::uint64_t mantissa = (bits & 0xFFFFFFFFFFFFF) | 0x10000000000000;

    // The digit that counts two quadrants is the first significant one.
    const int first = exponent + 62, shift = first % 64;
    std::uint64_t window[3];
    for (int i = 0; i < 3; ++i) {
        const std::uint64_t* word = digits + first / 64 + i;
        window[i] = shift == 0 ? word[0] : word[0] << shift | word[1] >> (64 - shift);
    }
    // In quadrants, modulo 4, times 2^126.
    const Wide low = static_cast<Wide>(mantissa) * window[2];
    const Wide turned = (static_cast<Wide>(mantissa * window[0]) << 64) +
                        static_cast<Wide>(mantissa) * window[1] + (low >> 64);

    const Wide nearest = (turned + (static_cast<Wide>(1) << 125)) >> 126;
    Wide rest = turned - (nearest << 126);
    const bool below = (rest >> 127) != 0;
    if (below) rest = -rest;
    const auto high = static_cast<std::uint64_t>(rest >> 64);
    const int zeros = high != 0 ? __builtin_clzll(high)
                                : 64 + __builtin_clzll(static_cast<std::uint64_t>(rest) | 1);
    const auto leading = static_cast<std::uint64_t>(rest << zeros >> 64);

    // In radians, times 2^(61 + zeros).
    const auto radians = static_cast<std::uint64_t>(static_cast<Wide>(leading) * half_pi >> 64);
    auto unit = __builtin_bit_cast(double, static_cast<std::uint64_t>(1023 - 61 - zeros) << 52);
    const bool negative = bits >> 63 != 0;
    if (negative != below) unit = 0.0 - unit;
    const auto quadrant = static_cast<double>(static_cast<std::int64_t>(nearest));
    return {negative ? 0.0 - quadrant : quadrant,
            static_cast<double>(static_cast<std::int64_t>(radians >> 11)) * 2048.0 * unit,
            static_cast<double>(static_cast<std::int64_t>(radians & 0x7FF)) * unit};
}

} // namespace raylane::core
