#pragma once

#include "core/scene/region.hpp"
#include "simd/threads.hpp"

#include <cstddef>
#include <functional>
#include <optional>

namespace raylane::simd {

/// The tiles of a part of a picture, `size` pixels on a side where it does not end before, by
/// number: row by row.
class TileGrid {
  public:
    TileGrid(const core::Region& part, int size);

    std::size_t count() const { return columns_ * rows_; }
    core::Region tile(std::size_t number) const;
    /// Of a tile of this grid.
    std::size_t number_of(const core::Region& tile) const;
    /// The i-th tile's number in an order in which any that follow one another are spread over the
    /// picture: their mean cost is soon that of all.
    std::size_t scattered(std::size_t i) const { return i * stride_ % count(); }
    const core::Region& part() const { return part_; }

  private:
    core::Region part_;
    std::size_t size_, columns_, rows_, stride_;
};

/// Says which tiles of a grid are visited here, where that is not for this process alone to know.
/// Asked by several threads.
class TileSource {
  public:
    TileSource() = default;
    virtual ~TileSource() = default;
    TileSource(const TileSource&) = delete;
    TileSource& operator=(const TileSource&) = delete;

    /// The next one for the calling thread, which may wait for it; nothing behind the last.
    virtual std::optional<std::size_t> next() = 0;
    /// A thread has failed: there are no more, whoever waits.
    virtual void cancel() = 0;
};

/// Calls visit(region) once for each tile of a grid, or for those of a source, on `threads` threads
/// (0: default_threads()). An exception ends the loop and comes out of it.
void for_each_tile(const TileGrid& grid, int threads,
                   const std::function<void(const core::Region&)>& visit,
                   TileSource* source = nullptr);

} // namespace raylane::simd
