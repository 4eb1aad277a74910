#pragma once

#include <bit>
#include <cstdint>

/// Points in a square for samples. All functions are inlined, for scalar code and kernels alike.
namespace raylane::core {

/// A point of [0, 1)^2.
struct SamplePoint {
    float x;
    float y;
};

/// A sample of a pixel.
struct SampleName {
    int x, y;   ///< the pixel
    int number; ///< in the pixel's sequence, from 0; or in its first grid, from -common to -1
    /// The number of samples of the first grid or, for samples of the sequence, the number that all
    /// pixels have. 0: unknown.
    int common = 0;
};

namespace detail {

[[gnu::always_inline]] constexpr std::uint32_t reversed_bits(std::uint32_t x) {
    x = x >> 16 | x << 16;
    x = (x & 0xFF00FF00U) >> 8 | (x & 0x00FF00FFU) << 8;
    x = (x & 0xF0F0F0F0U) >> 4 | (x & 0x0F0F0F0FU) << 4;
    x = (x & 0xCCCCCCCCU) >> 2 | (x & 0x33333333U) << 2;
    return (x & 0xAAAAAAAAU) >> 1 | (x & 0x55555555U) << 1;
}

/// Flips each bit or not, by a hash of the lower bits: Laine and Karras, "Stratified sampling for
/// stochastic transparency" (2011), with the constants of Vegdahl (2021).
[[gnu::always_inline]] constexpr std::uint32_t flipped_by_lower(std::uint32_t x,
                                                                std::uint32_t seed) {
    x ^= x * 0x3D20ADEAU;
    x += seed;
    x *= (seed >> 16) | 1U;
    x ^= x * 0x05526C56U;
    x ^= x * 0x53A22864U;
    return x;
}

[[gnu::always_inline]] constexpr float scrambled(std::uint32_t reversed, std::uint32_t seed) {
    return static_cast<float>(reversed_bits(flipped_by_lower(reversed, seed)) >> 8) * 0x1p-24F;
}

} // namespace detail

/// Choices of a pixel's samples, each with its own sequence. Soft lights follow, depth by depth.
enum SequenceUse : std::uint32_t { in_pixel = 0, on_lens = 1, on_first_light = 2 };

/// Returns the key of the sequence of pixel (x, y) for a use.
inline std::uint64_t sequence_key(std::uint32_t x, std::uint32_t y, std::uint32_t use) {
    std::uint64_t key = (static_cast<std::uint64_t>(y) << 32 | x) +
                        0x9E3779B97F4A7C15ULL * (use + std::uint64_t{1});
    key = (key ^ key >> 30) * 0xBF58476D1CE4E5B9ULL;
    key = (key ^ key >> 27) * 0x94D049BB133111EBULL;
    return key ^ key >> 31;
}

/// Returns point `number` of an unlimited sequence: Sobol's (0, 2)-sequence with Owen scrambling by
/// a hash of the key (Burley, "Practical Hash-based Owen Scrambling", 2020). The first 2^k points
/// have one in each cell of every division of the square into 2^k equal rectangles, and so has each
/// following block of 2^k.
[[gnu::always_inline]] constexpr SamplePoint sequence_point(std::uint64_t key,
                                                            std::uint32_t number) {
    // Sobol's second matrix, Pascal's triangle: each bit is the sum of the bits at all positions
    // whose binary digits include those of its position.
    std::uint32_t second = number;
    second ^= second >> 1 & 0x55555555U;
    second ^= second >> 2 & 0x33333333U;
    second ^= second >> 4 & 0x0F0F0F0FU;
    second ^= second >> 8 & 0x00FF00FFU;
    second ^= second >> 16;
    return {detail::scrambled(number, static_cast<std::uint32_t>(key)),
            detail::scrambled(second, static_cast<std::uint32_t>(key >> 32))};
}

/// Returns the same points, each block of 2^k in another order. A number that a sample has in
/// another sequence, or in a grid, then has no relation to the position of its point.
[[gnu::always_inline]] constexpr SamplePoint shuffled_point(std::uint64_t key,
                                                            std::uint32_t number) {
    const auto seed = static_cast<std::uint32_t>(key * 0x9E3779B97F4A7C15ULL >> 32);
    return sequence_point(
        key, detail::reversed_bits(detail::flipped_by_lower(detail::reversed_bits(number), seed)));
}

/// Consecutive points: shuffled_point(key, first), and so on.
struct PointRange {
    std::uint64_t key;
    std::uint32_t first;
};

/// Returns the `count` points of a sample on soft light number `light` of `lights`, as seen from
/// its hit at a depth.
///
/// Samples that all pixels have share one sequence in each square of 256 x 256 pixels, pixel by
/// pixel along a Z-order curve. So points are stratified within each pixel, and within each aligned
/// square of 2 x 2 pixels, 4 x 4 and so on: errors of neighbours cancel, and noise is blue. Source:
/// Ahmed and Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via
/// Hierarchical Ordering of Pixels" (2020). Further samples of a pixel use a sequence of that
/// pixel.
inline PointRange points_on_light(const SampleName& sample, std::uint32_t count, int depth,
                                  std::uint32_t light, std::uint32_t lights) {
    constexpr std::uint32_t side_bits = 8, most = 1U << (32 - 2 * side_bits);
    const auto x = static_cast<std::uint32_t>(sample.x), y = static_cast<std::uint32_t>(sample.y),
               common = static_cast<std::uint32_t>(sample.common);
    const bool is_in_grid = sample.number < 0;
    const std::uint32_t number =
        static_cast<std::uint32_t>(sample.number) + (is_in_grid ? common : 0U);
    const std::uint32_t use =
        SequenceUse::on_first_light + static_cast<std::uint32_t>(depth) * lights + light;
    if (number >= common || common > most / count) return {sequence_key(x, y, use), number * count};

    const auto spread = [](std::uint32_t coordinate) {
        std::uint32_t bits = 0;
        for (std::uint32_t bit = 0; bit < side_bits; ++bit)
            bits |= (coordinate >> bit & 1U) << 2 * bit;
        return bits;
    };
    const std::uint32_t pixel = spread(x) | spread(y) << 1;
    constexpr std::uint32_t of_grid = 1U << 30, of_sequence = 2U << 30;
    return {
        sequence_key(x >> side_bits, y >> side_bits, use + (is_in_grid ? of_grid : of_sequence)),
        pixel * std::bit_ceil(common * count) + number * count};
}

} // namespace raylane::core
