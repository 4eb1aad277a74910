#pragma once

#include "core/scene/camera_rays.hpp"

namespace raylane::core {

namespace detail {

constexpr std::uint32_t reversed_bits(std::uint32_t x) {
    x = x >> 16 | x << 16;
    x = (x & 0xFF00FF00U) >> 8 | (x & 0x00FF00FFU) << 8;
    x = (x & 0xF0F0F0F0U) >> 4 | (x & 0x0F0F0F0FU) << 4;
    x = (x & 0xCCCCCCCCU) >> 2 | (x & 0x33333333U) << 2;
    return (x & 0xAAAAAAAAU) >> 1 | (x & 0x55555555U) << 1;
}

/// Each bit is flipped or not by a hash of those below it: Laine and Karras, "Stratified sampling
/// for stochastic transparency" (2011), with the constants of Vegdahl (2021).
constexpr std::uint32_t flipped_by_lower(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3D20ADEAU;
    x += seed;
    x *= (seed >> 16) | 1U;
    x ^= x * 0x05526C56U;
    x ^= x * 0x53A22864U;
    return x;
}

} // namespace detail

/// Points of a pixel one after the other, any number of them: Sobol's (0, 2)-sequence, scrambled as
/// Owen has it by a hash of the pixel (Burley, "Practical Hash-based Owen Scrambling", 2020). The
/// first 2^k of them have one in each cell of every division of the pixel into 2^k equal
/// rectangles, and so has each 2^k that follow.
inline SamplePoint sequence_point(std::uint32_t x, std::uint32_t y, std::uint32_t number) {
    std::uint64_t key = (static_cast<std::uint64_t>(y) << 32 | x) + 0x9E3779B97F4A7C15ULL;
    key = (key ^ key >> 30) * 0xBF58476D1CE4E5B9ULL;
    key = (key ^ key >> 27) * 0x94D049BB133111EBULL;
    key ^= key >> 31;

    std::uint32_t second = 0; // by Sobol's second matrix, Pascal's triangle
    std::uint32_t column = 1U << 31;
    for (std::uint32_t bits = number; bits != 0; bits >>= 1, column ^= column >> 1)
        if ((bits & 1U) != 0) second ^= column;
    const auto scrambled = [](std::uint32_t reversed, std::uint32_t seed) {
        const std::uint32_t bits = detail::reversed_bits(detail::flipped_by_lower(reversed, seed));
        return static_cast<float>(bits >> 8) * 0x1p-24F;
    };
    return {scrambled(number, static_cast<std::uint32_t>(key)),
            scrambled(detail::reversed_bits(second), static_cast<std::uint32_t>(key >> 32))};
}

} // namespace raylane::core
