#pragma once

#include <functional>

namespace raylane::simd {

/// More than any machine has of use.
inline constexpr int max_threads = 4096;

/// As many as the machine has for this process.
int default_threads();

/// Calls body(), whose parallel loops then run on `threads` threads (0: default_threads()). An
/// exception comes out of it.
void on_threads(int threads, const std::function<void()>& body);

} // namespace raylane::simd
