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

void on_threads(int threads, const std::function<void()>& body) {
    // More threads than processors have to be allowed, or oneTBB prints a warning.
    using Control = tbb::global_control;
    const std::size_t allowed =
        std::max<std::size_t>(Control::active_value(Control::max_allowed_parallelism),
                              static_cast<std::size_t>(std::max(threads, 0)));
    const Control control(Control::max_allowed_parallelism, allowed);
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute(body);
}

} // namespace raylane::simd
