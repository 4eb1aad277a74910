#pragma once

#include "simd/render.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace raylane::scenes {

/// The tiles of a picture, or of the part of it that is drawn, by number; and what one of them
/// shows, as bytes: its counters, and for each pixel, row by row, three floats, an alpha if the
/// picture has one, and of those in the crop the layers if it has any. In this machine's order of
/// bytes, as all are that this runs on.
class TileRecords {
  public:
    /// Of this rendering.
    TileRecords(const core::Settings& settings, const simd::RenderOptions& options);

    std::size_t count() const { return columns_ * rows_; }
    std::size_t number_of(const core::Region& tile) const;
    core::Region tile(std::size_t number) const;
    std::size_t bytes(std::size_t number) const;

    /// Adds the bytes of a tile to a text.
    void append(const simd::FinishedTile& tile, std::string& bytes) const;
    /// From as many bytes as that tile has.
    void fill(const simd::TileToFill& tile, std::span<const char> bytes) const;

  private:
    core::Region part_, crop_;
    std::size_t size_, columns_, rows_;
    bool alpha_, layers_;
};

} // namespace raylane::scenes
