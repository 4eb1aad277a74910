#include "simd/tiles.hpp"

#include <algorithm>

namespace raylane::simd {

void for_each_tile(const core::Region& part, int tile_size, int threads,
                   const std::function<void(const core::Region&)>& visit) {
    const int columns = (part.x1 - part.x0 + tile_size - 1) / tile_size;
    const int rows = (part.y1 - part.y0 + tile_size - 1) / tile_size;
    on_threads(threads, [&] {
        const std::size_t count = static_cast<std::size_t>(columns) * static_cast<unsigned>(rows);
        parallel_for(count, [&](std::size_t number) {
            const int tile = static_cast<int>(number);
            const int x = part.x0 + tile % columns * tile_size,
                      y = part.y0 + tile / columns * tile_size;
            visit({x, y, std::min(x + tile_size, part.x1), std::min(y + tile_size, part.y1)});
        });
    });
}

} // namespace raylane::simd
