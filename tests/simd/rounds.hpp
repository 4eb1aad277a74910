#pragma once

#include "tests/sanitized.hpp"

#include <cstdlib>

namespace raylane::tests {

/// How often to repeat what is random. RAYLANE_TEST_ROUNDS asks for fewer where a processor is
/// emulated.
inline int rounds(int usual) {
    const char* const wanted = std::getenv("RAYLANE_TEST_ROUNDS");
    return wanted != nullptr ? std::atoi(wanted) : sanitized ? 20 : usual;
}

} // namespace raylane::tests
