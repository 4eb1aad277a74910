#include "simd/tiles.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace raylane::simd {

void for_each_tile(int width, int height, int tile_size, int threads,
                   const std::function<void(const core::Region&)>& visit) {
    const int columns = (width + tile_size - 1) / tile_size;
    const int rows = (height + tile_size - 1) / tile_size;
    on_threads(threads, [&] {
        tbb::parallel_for(0, columns * rows, [&](int tile) {
            const int x = tile % columns * tile_size, y = tile / columns * tile_size;
            visit({x, y, std::min(x + tile_size, width), std::min(y + tile_size, height)});
        });
    });
}

} // namespace raylane::simd
