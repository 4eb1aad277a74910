#pragma once

#include "core/scene/region.hpp"

#include <cstddef>
#include <functional>
#include <optional>

namespace raylane::simd {

/// The tiles of a part of an image, numbered row by row. Tiles have `size` pixels on a side, or
/// fewer where the part ends.
class TileGrid {
  public:
    TileGrid(const core::Region& part, int size);

    std::size_t count() const { return columns_ * rows_; }
    core::Region tile(std::size_t number) const;
    /// Returns the number of a tile of this grid.
    std::size_t number_of(const core::Region& tile) const;
    /// Returns the number of the i-th tile in a scattered order. Consecutive tiles are spread over
    /// the image, so their mean cost soon approaches the overall mean.
    std::size_t scattered(std::size_t i) const { return i * stride_ % count(); }
    const core::Region& part() const { return part_; }

  private:
    core::Region part_;
    std::size_t size_, columns_, rows_, stride_;
};

/// Decides which tiles of a grid this process visits, where several processes share an image.
/// Called by several threads.
class TileSource {
  public:
    TileSource() = default;
    virtual ~TileSource() = default;
    TileSource(const TileSource&) = delete;
    TileSource& operator=(const TileSource&) = delete;

    /// Returns the next tile for the calling thread, perhaps after waiting; nothing after the last.
    virtual std::optional<std::size_t> next() = 0;
    /// Ends the tiles for all threads, also for those that wait. Called when a thread has failed.
    virtual void cancel() = 0;
};

/// Calls visit(region) once for each tile of a grid, or for those of `source` if it is not null, on
/// `threads` threads (0: default_threads()). An exception ends the loop and propagates.
void for_each_tile(const TileGrid& grid, int threads,
                   const std::function<void(const core::Region&)>& visit,
                   TileSource* source = nullptr);

} // namespace raylane::simd
