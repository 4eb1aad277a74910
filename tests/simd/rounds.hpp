#pragma once

#include "tests/sanitized.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace raylane::tests {

/// Number of rounds of what is random. RAYLANE_TEST_ROUNDS asks for fewer where a processor is
/// emulated; sanitizers allow for a few.
inline int rounds(int usual, int few = 20) {
    const char* const wanted = std::getenv("RAYLANE_TEST_ROUNDS");
    return wanted != nullptr ? std::atoi(wanted) : sanitized ? few : usual;
}

/// Seed of random numbers. RAYLANE_TEST_SEED asks for others than usual.
inline std::uint64_t seed(std::uint64_t usual) {
    const char* const wanted = std::getenv("RAYLANE_TEST_SEED");
    return wanted == nullptr ? usual
                             : usual + 0x9e3779b97f4a7c15 * std::strtoull(wanted, nullptr, 10);
}

/// Most of what is rare (Poisson's) where so many are expected: four deviations more.
inline double most_by_chance(double expected) {
    return expected + 4.0 * std::sqrt(expected);
}

} // namespace raylane::tests
