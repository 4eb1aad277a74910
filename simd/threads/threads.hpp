#pragma once

#include "core/hierarchy/workers.hpp"
#include "simd/isa/isa.hpp"

#include <cstddef>
#include <functional>
#include <memory>

namespace raylane::simd {

/// More than any machine can use.
inline constexpr int max_threads = 4096;

/// Returns the number of threads in the environment variable RAYLANE_THREADS or, if that is unset
/// or empty, the number that the machine offers this process. Throws InvalidValue if the variable
/// is not a whole number from 1 to max_threads.
int default_threads();

/// Allows this number of threads while it lives, even on fewer processors. Without it, oneTBB would
/// print a warning.
class AllowedThreads {
  public:
    explicit AllowedThreads(int threads);
    ~AllowedThreads();

  private:
    struct Control;
    std::unique_ptr<Control> control_;
};

/// Calls body(). Its parallel loops run on `threads` threads (0: default_threads()). Exceptions
/// propagate.
void on_threads(int threads, const std::function<void()>& body);

/// Run tasks on the arena's threads, like tbb::parallel_for and tbb::parallel_invoke. Exceptions
/// propagate. The thread sanitizer cannot see into oneTBB, and threads.cpp is built without it, so
/// these functions report to it when tasks start and end.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& task);
void parallel_invoke(const std::function<void()>& one, const std::function<void()>& other);

/// Calls body() from a task. While body() waits, this thread does not begin another task.
void isolate(const std::function<void()>& body);

/// Runs the tasks of a build on `threads` threads (0: default_threads()).
class ParallelWorkers : public core::Workers {
  public:
    explicit ParallelWorkers(int threads = 0, int node_width = simd::node_width());
    ~ParallelWorkers() override;

    void both(const Task& one, const Task& other) override;
    void each(std::size_t count, const std::function<void(std::size_t)>& task) override;

  private:
    struct Arena;
    std::unique_ptr<Arena> arena_;
};

} // namespace raylane::simd
