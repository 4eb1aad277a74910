#pragma once

#include "core/hierarchy/workers.hpp"

#include <memory>

namespace raylane::simd {

/// Runs the tasks of a build on `threads` threads (0: default_threads()).
class ParallelWorkers : public core::Workers {
  public:
    explicit ParallelWorkers(int threads = 0);
    ~ParallelWorkers() override;

    void both(const Task& one, const Task& other) override;
    void each(std::size_t count, const std::function<void(std::size_t)>& task) override;

  private:
    struct Arena;
    std::unique_ptr<Arena> arena_;
};

} // namespace raylane::simd
