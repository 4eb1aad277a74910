#pragma once

#include "simd/render.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace raylane::scenes {

/// What the tiles of a picture show, as bytes, each by itself: its counters, and for each pixel,
/// row by row, three floats, an alpha if the picture has one, and of those in the crop the layers
/// if it has any. In this machine's order of bytes, as all are that this runs on.
class TileRecords {
  public:
    /// Of this rendering.
    TileRecords(const core::Settings& settings, const simd::RenderOptions& options);

    const simd::TileGrid& grid() const { return grid_; }
    std::size_t bytes(std::size_t number) const;

    /// Adds the bytes of a tile to a text.
    void append(const simd::FinishedTile& tile, std::string& bytes) const;
    /// From as many bytes as that tile has.
    void fill(const simd::TileToFill& tile, std::span<const char> bytes) const;

  private:
    simd::TileGrid grid_;
    core::Region crop_;
    bool alpha_, layers_;
};

} // namespace raylane::scenes
