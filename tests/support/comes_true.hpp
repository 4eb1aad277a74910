#pragma once

#include <chrono>
#include <thread>

namespace raylane::tests {

/// Waits until a condition holds, which is checked every millisecond. Returns false after ten
/// minutes. This is how tests wait for an event: the limit ends a test that hangs, and decides
/// nothing else.
template <class Condition>
bool comes_true(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

} // namespace raylane::tests
