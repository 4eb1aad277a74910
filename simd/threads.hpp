#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace raylane::simd {

/// More than any machine has of use.
inline constexpr int max_threads = 4096;

/// Number of threads that the environment's RAYLANE_THREADS says, else what the machine has for
/// this process. Throws InvalidValue for one that is no number of threads.
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

/// Tasks of the arena's threads, as tbb::parallel_for and tbb::parallel_invoke run them; an
/// exception comes out of it. The thread sanitizer, which cannot look into oneTBB (threads.cpp is
/// built without it), is told when they start and end.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& task);
void parallel_invoke(const std::function<void()>& one, const std::function<void()>& other);

/// Calls body() from a task; what it waits for does not make this thread begin another one.
void isolate(const std::function<void()>& body);

} // namespace raylane::simd
