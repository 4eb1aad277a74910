#pragma once

#include "scenes/tool/journal/tile_records.hpp"
#include "scenes/tool/ranks/shared_work.hpp"

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

namespace raylane::scenes {

/// The tiles of a picture that the ranks of a job draw together. The picture is rank 0's, which
/// gets the tiles that others have drawn as they come; theirs has those alone that they draw.
class RankedTiles : public simd::TileSource {
  public:
    /// What there is to be done, for rank 0 to say.
    struct Tiles {
        std::vector<std::uint32_t> to_draw;  ///< by any rank, in order
        std::vector<std::uint32_t> to_visit; ///< by rank 0, which knows what they show
    };

    /// All together, on so many threads here. `stop` as SharedWork has it.
    RankedTiles(Ranks& ranks, Tiles tiles, const TileRecords& records, int threads,
                std::atomic<bool>& stop);

    std::optional<std::size_t> next() override;
    void cancel() override { work_.cancel(); }

    /// For simd::RenderOptions: fills a tile that another rank has drawn, and returns its bytes;
    /// sends one to rank 0.
    std::optional<std::string> recall(const simd::TileToFill& tile);
    void note(const simd::FinishedTile& tile);

    /// All together, behind the drawing. Of tiles that have come too late to be drawn, as it was
    /// stopped, the numbers and bytes.
    std::vector<std::pair<std::size_t, std::string>> finish();

  private:
    Ranks& ranks_;
    Tiles tiles_;
    const TileRecords& records_;
    SharedWork work_;
    std::mutex mutex_; // of what follows
    std::size_t visited_ = 0;
    std::unordered_map<std::size_t, std::string> drawn_elsewhere_; // not filled in yet
};

} // namespace raylane::scenes
