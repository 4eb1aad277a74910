#pragma once

#include "scenes/tool/checkpoint/tile_records.hpp"
#include "scenes/tool/ranks/shared_work.hpp"

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace raylane::scenes {

/// The tiles of an image that the ranks of a job render together. Rank 0 has the whole image, and
/// receives the tiles of other ranks as they arrive. The images of other ranks have only the
/// tiles that these render.
class RankedTiles : public simd::TileSource {
  public:
    /// The work to do, which rank 0 determines.
    struct Tiles {
        std::vector<std::uint32_t> to_draw;  ///< by any rank, in order
        std::vector<std::uint32_t> to_visit; ///< by rank 0, which has their contents
    };

    /// Collective, with `threads` threads here. `stop`: see SharedWork.
    RankedTiles(Ranks& ranks, Tiles tiles, const TileRecords& records, int threads,
                std::atomic<bool>& stop);

    std::optional<std::size_t> next() override;
    void cancel() override { work_.cancel(); }

    /// Callbacks for simd::RenderOptions. recall() fills a tile that another rank has rendered and
    /// returns its bytes; note() sends a tile to rank 0.
    std::optional<std::string> recall(const simd::TileToFill& tile);
    void note(const simd::FinishedTile& tile);

    /// Collective, after the rendering. Returns numbers and bytes of tiles that arrived too late to
    /// be filled in, because the rendering was stopped.
    std::vector<std::pair<std::size_t, std::string>> finish();

  private:
    Ranks& ranks_;
    Tiles tiles_;
    const TileRecords& records_;
    SharedWork work_;
    std::mutex mutex_; // protects the members below
    std::size_t visited_ = 0;
    std::unordered_map<std::size_t, std::string> drawn_elsewhere_; // not filled in yet
};

} // namespace raylane::scenes
