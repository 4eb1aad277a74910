#include "simd/threads/threads.hpp"

#include <tbb/task_arena.h>

namespace raylane::simd {

struct ParallelWorkers::Arena {
    AllowedThreads allowed;
    tbb::task_arena arena;

    explicit Arena(int threads) : allowed(threads), arena(threads) {}
};

ParallelWorkers::ParallelWorkers(int threads, int node_width)
    : Workers(node_width),
      arena_(std::make_unique<Arena>(threads > 0 ? threads : default_threads())) {}
ParallelWorkers::~ParallelWorkers() = default;

void ParallelWorkers::both(const Task& one, const Task& other) {
    arena_->arena.execute([&] { parallel_invoke(one, other); });
}

void ParallelWorkers::each(std::size_t count, const std::function<void(std::size_t)>& task) {
    if (count <= 1) return Workers::each(count, task); // wakes no thread for a small scene
    arena_->arena.execute([&] { parallel_for(count, task); });
}

} // namespace raylane::simd
