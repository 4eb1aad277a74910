#include "simd/tiles.hpp"

#include <algorithm>

namespace raylane::simd {

void for_each_tile(int width, int height, int tile_size, int threads,
                   const std::function<void(const core::Region&)>& visit) {
    const int columns = (width + tile_size - 1) / tile_size;
    const int rows = (height + tile_size - 1) / tile_size;
    on_threads(threads, [&] {
        const std::size_t count = static_cast<std::size_t>(columns) * static_cast<unsigned>(rows);
        parallel_for(count, [&](std::size_t number) {
            const int tile = static_cast<int>(number);
            const int x = tile % columns * tile_size, y = tile / columns * tile_size;
            visit({x, y, std::min(x + tile_size, width), std::min(y + tile_size, height)});
        });
    });
}

} // namespace raylane::simd
