#pragma once

#include "tests/support/sanitized.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace raylane::tests {

/// Returns whether RAYLANE_TEST_ROUNDS is `full`, as in `.ci/nightly`. Tests then take the time
/// that they need.
inline bool is_full() {
    const char* const wanted = std::getenv("RAYLANE_TEST_ROUNDS");
    return wanted != nullptr && std::strcmp(wanted, "full") == 0;
}

/// Returns the number of rounds of a random test: `usual`, with sanitizers `few`, in full runs
/// `full` if given. RAYLANE_TEST_ROUNDS may be another number, for example a small one on an
/// emulated processor.
inline int rounds(int usual, int few = 20, int full = 0) {
    if (is_full()) return full != 0 ? full : usual;
    const char* const wanted = std::getenv("RAYLANE_TEST_ROUNDS");
    return wanted != nullptr ? std::atoi(wanted) : sanitized ? few : usual;
}

/// Returns the number of rounds of a test whose checks need that many. RAYLANE_TEST_ROUNDS has an
/// effect only if it is `full`.
inline int fixed_rounds(int usual, int few, int full) {
    return is_full() ? full : sanitized ? few : usual;
}

/// Returns a seed of random numbers. RAYLANE_TEST_SEED selects other seeds than usual.
inline std::uint64_t seed(std::uint64_t usual) {
    const char* const wanted = std::getenv("RAYLANE_TEST_SEED");
    return wanted == nullptr ? usual
                             : usual + 0x9e3779b97f4a7c15 * std::strtoull(wanted, nullptr, 10);
}

/// Returns the most that is plausible of a rare (Poisson) event with this expected count: four
/// standard deviations more.
inline double max_by_chance(double expected) {
    return expected + 4.0 * std::sqrt(expected);
}

} // namespace raylane::tests
