#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace raylane::core {

/// Adds counters to others. The struct must consist of them alone.
template <class Counts>
Counts& add_counts(Counts& sum, const Counts& more) {
    using Numbers = std::array<std::uint64_t, sizeof(Counts) / sizeof(std::uint64_t)>;
    auto numbers = std::bit_cast<Numbers>(sum);
    const auto added = std::bit_cast<Numbers>(more);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] += added[i];
    return sum = std::bit_cast<Counts>(numbers);
}

/// Counters of the work of a rendering.
struct Counters {
    std::uint64_t primary = 0;   ///< rays from the camera
    std::uint64_t reflected = 0; ///< rays
    std::uint64_t refracted = 0; ///< rays
    std::uint64_t passed = 0;    ///< rays that continue behind transparent surfaces
    std::uint64_t shadow = 0;    ///< rays
    std::uint64_t nodes = 0;     ///< wide nodes visited
    std::uint64_t shapes = 0;    ///< rays tested against one shape
    std::uint64_t widened = 0;   ///< tests of `shapes` that had to be repeated in more than double

    std::uint64_t rays() const { return primary + reflected + refracted + passed + shadow; }

    Counters& operator+=(const Counters& other) { return add_counts(*this, other); }
};

/// Counters of comparisons of crossings, by the stage that decided them.
struct OrderCounters {
    std::uint64_t by_bounds = 0; ///< intervals in double
    std::uint64_t by_digits = 0; ///< double-double with bounds
    std::uint64_t exactly = 0;   ///< signs of resultants
};

} // namespace raylane::core
