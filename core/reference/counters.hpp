#pragma once

#include <cstdint>

namespace raylane::core {

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

    Counters& operator+=(const Counters& other) {
        primary += other.primary;
        reflected += other.reflected;
        refracted += other.refracted;
        passed += other.passed;
        shadow += other.shadow;
        nodes += other.nodes;
        shapes += other.shapes;
        widened += other.widened;
        return *this;
    }
};

/// Counters of comparisons of crossings, by the stage that decided them.
struct OrderCounters {
    std::uint64_t by_bounds = 0; ///< intervals in double
    std::uint64_t by_digits = 0; ///< double-double with bounds
    std::uint64_t exactly = 0;   ///< signs of resultants

    OrderCounters& operator+=(const OrderCounters& other) {
        by_bounds += other.by_bounds;
        by_digits += other.by_digits;
        exactly += other.exactly;
        return *this;
    }
};

} // namespace raylane::core
