#include "simd/threads.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace raylane::simd {

int default_threads() {
    return tbb::info::default_concurrency();
}

struct AllowedThreads::Control : tbb::global_control {
    using tbb::global_control::global_control;
};

AllowedThreads::AllowedThreads(int threads)
    : control_(std::make_unique<Control>(
          Control::max_allowed_parallelism,
          std::max<std::size_t>(Control::active_value(Control::max_allowed_parallelism),
                                static_cast<std::size_t>(std::max(threads, 0))))) {}
AllowedThreads::~AllowedThreads() = default;

void on_threads(int threads, const std::function<void()>& body) {
    const AllowedThreads allowed(threads);
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute(body);
}

} // namespace raylane::simd
