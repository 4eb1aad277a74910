#include "simd/wavefront/tiles.hpp"

#include "simd/threads/threads.hpp"

#include <cmath>
#include <numeric>

namespace raylane::simd {

namespace {

/// Returns a stride that has no common factor with the number of tiles. So its multiples, modulo
/// that number, visit all tiles. The stride is the golden ratio times the number of tiles,
/// increased until they have no common factor. So any few consecutive multiples are spread evenly.
std::size_t stride_of(std::size_t tiles) {
    constexpr double golden_ratio = 0.6180339887498949;
    auto stride = static_cast<std::size_t>(std::llround(golden_ratio * static_cast<double>(tiles)));
    while (std::gcd(stride, tiles) != 1)
        ++stride;
    return stride;
}

} // namespace

TileGrid::TileGrid(const core::Region& part, int size)
    : part_(part), size_(static_cast<std::size_t>(size)),
      columns_((static_cast<std::size_t>(part.x1 - part.x0) + size_ - 1) / size_),
      rows_((static_cast<std::size_t>(part.y1 - part.y0) + size_ - 1) / size_),
      stride_(stride_of(count())) {}

core::Region TileGrid::tile(std::size_t number) const {
    const int size = static_cast<int>(size_);
    const int x = part_.x0 + static_cast<int>(number % columns_) * size;
    const int y = part_.y0 + static_cast<int>(number / columns_) * size;
    return core::Region{x, y, x + size, y + size}.within(part_);
}

std::size_t TileGrid::number_of(const core::Region& tile) const {
    return static_cast<std::size_t>(tile.y0 - part_.y0) / size_ * columns_ +
           static_cast<std::size_t>(tile.x0 - part_.x0) / size_;
}

void for_each_tile(const TileGrid& grid, int threads,
                   const std::function<void(const core::Region&)>& visit, TileSource* source) {
    on_threads(threads, [&] {
        if (source == nullptr)
            return parallel_for(grid.count(),
                                [&](std::size_t i) { visit(grid.tile(grid.scattered(i))); });
        const int count = threads > 0 ? threads : default_threads();
        parallel_for(static_cast<std::size_t>(count), [&](std::size_t) {
            try {
                while (const std::optional<std::size_t> number = source->next())
                    visit(grid.tile(*number));
            } catch (...) {
                source->cancel();
                throw;
            }
        });
    });
}

} // namespace raylane::simd
