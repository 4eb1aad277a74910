#pragma once

#include "core/numbers/dyadic.hpp"

#include <bit>
#include <concepts>
#include <cstdint>
#include <type_traits>

namespace raylane::core {

/// Returns the float or double nearest to a number, ties to even. It must be one of those from
/// `low` to `high`, which are >= 0. `order_of`(sum) returns the order of twice the number and the
/// sum of two neighbours: -1 if the number is less than their middle, 0 if it is equal, 1 if it is
/// more.
template <std::floating_point Real, class Order>
Real nearest_between(Real low, Real high, const Order& order_of) {
    using Bits = std::conditional_t<std::is_same_v<Real, float>, std::uint32_t, std::uint64_t>;
    // Bisects over the bit patterns, which are in the order of the numbers for numbers that are not
    // negative.
    auto below = std::bit_cast<Bits>(low), above = std::bit_cast<Bits>(high);
    while (below < above) {
        const Bits next = below + (above - below) / 2;
        const int side = order_of(Dyadic(std::bit_cast<Real>(next)) +
                                  Dyadic(std::bit_cast<Real>(Bits(next + 1))));
        if (side < 0 || (side == 0 && (next & 1) == 0))
            above = next;
        else
            below = next + 1;
    }
    return std::bit_cast<Real>(below);
}

} // namespace raylane::core
