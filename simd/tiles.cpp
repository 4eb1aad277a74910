#include "simd/tiles.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace raylane::simd {

int default_threads() {
    return tbb::info::default_concurrency();
}

void for_each_tile(int width, int height, int tile_size, int threads,
                   const std::function<void(const core::Region&)>& visit) {
    const int columns = (width + tile_size - 1) / tile_size;
    const int rows = (height + tile_size - 1) / tile_size;
    // More threads than processors have to be allowed, or oneTBB prints a warning.
    using Control = tbb::global_control;
    const std::size_t allowed =
        std::max<std::size_t>(Control::active_value(Control::max_allowed_parallelism),
                              static_cast<std::size_t>(std::max(threads, 0)));
    const Control control(Control::max_allowed_parallelism, allowed);
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(0, columns * rows, [&](int tile) {
            const int x = tile % columns * tile_size, y = tile / columns * tile_size;
            visit({x, y, std::min(x + tile_size, width), std::min(y + tile_size, height)});
        });
    });
}

} // namespace raylane::simd
