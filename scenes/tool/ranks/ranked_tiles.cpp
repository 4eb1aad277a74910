#include "scenes/tool/ranks/ranked_tiles.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes {

namespace {

/// Collective: returns the numbers of rank 0.
std::vector<std::uint32_t> shared(Ranks& ranks, std::vector<std::uint32_t> numbers) {
    std::uint64_t count = numbers.size();
    ranks.broadcast(&count, sizeof count);
    numbers.resize(count);
    ranks.broadcast(numbers.data(), count * sizeof(std::uint32_t));
    return numbers;
}

} // namespace

RankedTiles::RankedTiles(Ranks& ranks, Tiles tiles, const TileRecords& records, int threads,
                         std::atomic<bool>& stop)
    : ranks_(ranks), tiles_{shared(ranks, std::move(tiles.to_draw)), std::move(tiles.to_visit)},
      records_(records), work_(ranks, tiles_.to_draw.size(), threads, stop) {}

std::optional<std::size_t> RankedTiles::next() {
    if (ranks_.rank() == 0) {
        const std::lock_guard lock(mutex_);
        if (visited_ < tiles_.to_visit.size()) return tiles_.to_visit[visited_++];
    }
    std::optional<SharedWork::Piece> piece = work_.next();
    if (!piece) return std::nullopt;
    const std::size_t tile = tiles_.to_draw[piece->number];
    if (!piece->is_done) return tile;
    const std::lock_guard lock(mutex_);
    drawn_elsewhere_.emplace(tile, std::move(piece->bytes));
    return tile;
}

std::optional<std::string> RankedTiles::recall(const simd::TileToFill& tile) {
    std::unique_lock lock(mutex_);
    auto found = drawn_elsewhere_.extract(records_.grid().number_of(tile.region));
    lock.unlock();
    if (found.empty()) return std::nullopt;
    records_.fill(tile, found.mapped());
    return std::move(found.mapped());
}

void RankedTiles::note(const simd::FinishedTile& tile) {
    if (ranks_.rank() == 0) return;
    std::string bytes;
    records_.append(tile, bytes);
    const auto& tiles = tiles_.to_draw;
    const auto place =
        std::lower_bound(tiles.begin(), tiles.end(), records_.grid().number_of(tile.region));
    work_.done(static_cast<std::size_t>(place - tiles.begin()), bytes);
}

std::vector<std::pair<std::size_t, std::string>> RankedTiles::finish() {
    std::vector<std::pair<std::size_t, std::string>> late;
    for (SharedWork::Piece& piece : work_.finish())
        late.emplace_back(tiles_.to_draw[piece.number], std::move(piece.bytes));
    for (auto& [tile, bytes] : drawn_elsewhere_)
        late.emplace_back(tile, std::move(bytes));
    return late;
}

} // namespace raylane::scenes
