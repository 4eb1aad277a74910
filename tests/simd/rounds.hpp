#pragma once

#include "tests/sanitized.hpp"

#include <cstdlib>

namespace raylane::tests {

/// How often to repeat what is random. RAYLANE_TEST_ROUNDS asks for fewer where a processor is
/// emulated; sanitizers allow for a few.
inline int rounds(int usual, int few = 20) {
    const char* const wanted = std::getenv("RAYLANE_TEST_ROUNDS");
    return wanted != nullptr ? std::atoi(wanted) : sanitized ? few : usual;
}

} // namespace raylane::tests
