#pragma once

#include "simd/wavefront/render.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace raylane::scenes {

/// Converts single tiles of an image to bytes: the counters; three floats for each pixel, row by
/// row; the alphas, if the image has any; and, if it has AOVs, those of the pixels in the crop.
/// The byte order is that of this machine, and of all machines that raylane runs on.
class TileRecords {
  public:
    /// For the tiles of this rendering.
    TileRecords(const core::Settings& settings, const simd::RenderOptions& options);

    const simd::TileGrid& grid() const { return grid_; }
    std::size_t bytes(std::size_t number) const;

    /// Appends the bytes of a tile.
    void append(const simd::FinishedTile& tile, std::string& bytes) const;
    /// Fills a tile from as many bytes as its record has.
    void fill(const simd::TileToFill& tile, std::span<const char> bytes) const;

  private:
    simd::TileGrid grid_;
    core::Region crop_;
    bool alpha_, aovs_;
};

} // namespace raylane::scenes
