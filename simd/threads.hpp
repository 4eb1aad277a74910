#pragma once

#include <functional>
#include <memory>

namespace raylane::simd {

/// More than any machine has of use.
inline constexpr int max_threads = 4096;

/// As many as the machine has for this process.
int default_threads();

/// While it lives, so many threads are allowed even where there are fewer processors: oneTBB would
/// print a warning.
class AllowedThreads {
  public:
    explicit AllowedThreads(int threads);
    ~AllowedThreads();

  private:
    struct Control;
    std::unique_ptr<Control> control_;
};

/// Calls body(), whose parallel loops then run on `threads` threads (0: default_threads()). An
/// exception comes out of it.
void on_threads(int threads, const std::function<void()>& body);

} // namespace raylane::simd
