#include "simd/threads/default_rounding.hpp"
#include "simd/threads/threads.hpp"

/// Implements threads.hpp without oneTBB, on the caller's thread alone.
namespace raylane::simd {

int default_threads() {
    return 1;
}

struct AllowedThreads::Control {};
AllowedThreads::AllowedThreads(int threads) {
    static_cast<void>(threads);
}
AllowedThreads::~AllowedThreads() = default;

void on_threads(int threads, const std::function<void()>& body) {
    static_cast<void>(threads);
    const DefaultRounding rounding;
    body();
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& task) {
    for (std::size_t i = 0; i < count; ++i)
        task(i);
}

void parallel_invoke(const std::function<void()>& one, const std::function<void()>& other) {
    one();
    other();
}

void isolate(const std::function<void()>& body) {
    body();
}

struct ParallelWorkers::Arena {};
ParallelWorkers::ParallelWorkers(int threads, int node_width) : Workers(node_width) {
    static_cast<void>(threads);
}
ParallelWorkers::~ParallelWorkers() = default;

void ParallelWorkers::both(const Task& one, const Task& other) {
    Workers::both(one, other);
}

void ParallelWorkers::each(std::size_t count, const std::function<void(std::size_t)>& task) {
    Workers::each(count, task);
}

} // namespace raylane::simd
