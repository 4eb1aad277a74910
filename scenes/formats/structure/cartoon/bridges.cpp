#include "scenes/formats/structure/cartoon/bridges.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace raylane::scenes {

namespace {

enum class BridgeType : std::uint8_t { none, parallel, antiparallel };

/// Consecutive bridges of one type. The first residues ascend. Those that they are bonded to ascend
/// or, in antiparallel ladders, descend.
struct Ladder {
    BridgeType type;
    std::size_t first, last;             ///< of one strand
    std::size_t other_first, other_last; ///< of the other strand, ascending
    std::size_t bridges = 1;
};

class Ladders {
  public:
    Ladders(const HydrogenBonds& bonds, const std::vector<std::size_t>& piece_of)
        : bonds_(bonds), piece_of_(piece_of) {}

    std::vector<Ladder> find() {
        for (const auto& [i, j] : candidates())
            if (const BridgeType type = type_of(i, j); type != BridgeType::none) add(type, i, j);
        std::stable_sort(ladders_.begin(), ladders_.end(),
                         [](const Ladder& a, const Ladder& b) { return a.first < b.first; });
        join();
        return std::move(ladders_);
    }

  private:
    using Pair = std::pair<std::size_t, std::size_t>;

    /// Returns the pairs of residues next to the ends of hydrogen bonds: each bridge is one.
    std::vector<Pair> candidates() const {
        std::vector<Pair> pairs;
        bonds_.for_each([&](std::size_t donor, std::size_t acceptor) {
            for (std::size_t i = donor == 0 ? 0 : donor - 1; i <= donor + 1; ++i)
                for (std::size_t j = acceptor == 0 ? 0 : acceptor - 1; j <= acceptor + 1; ++j)
                    if (const Pair pair = std::minmax(i, j); pair.second >= pair.first + 3)
                        pairs.push_back(pair);
        });
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        return pairs;
    }

    bool are_joined(std::size_t a, std::size_t b) const { return piece_of_[a] == piece_of_[b]; }
    bool has_neighbours(std::size_t i) const {
        return i > 0 && i + 1 < piece_of_.size() && are_joined(i - 1, i + 1);
    }

    BridgeType type_of(std::size_t i, std::size_t j) const {
        if (!has_neighbours(i) || !has_neighbours(j)) return BridgeType::none;
        if ((bonds_.has(i + 1, j) && bonds_.has(j, i - 1)) ||
            (bonds_.has(j + 1, i) && bonds_.has(i, j - 1)))
            return BridgeType::parallel;
        if ((bonds_.has(i + 1, j - 1) && bonds_.has(j + 1, i - 1)) ||
            (bonds_.has(j, i) && bonds_.has(i, j)))
            return BridgeType::antiparallel;
        return BridgeType::none;
    }

    /// Appends a bridge to the ladder that it continues. Only ladders that end at the residue
    /// before are candidates. Bridges come by ascending residue.
    void add(BridgeType type, std::size_t i, std::size_t j) {
        while (first_open_ < ladders_.size() && ladders_[first_open_].last + 1 < i)
            ++first_open_;
        for (std::size_t k = first_open_; k < ladders_.size(); ++k) {
            Ladder& ladder = ladders_[k];
            if (ladder.type != type || ladder.last + 1 != i) continue;
            const bool is_parallel = type == BridgeType::parallel;
            if (is_parallel ? ladder.other_last + 1 != j : ladder.other_first != j + 1) continue;
            (is_parallel ? ladder.other_last : ladder.other_first) = j;
            ladder.last = i;
            ++ladder.bridges;
            return;
        }
        ladders_.push_back({type, i, i, j, j});
    }

    /// Returns true if only a bulge separates two ladders, the second of which begins later. One
    /// strand has at most one residue between them, and the other one at most four.
    bool has_bulge(const Ladder& a, const Ladder& b) const {
        if (a.type != b.type || !are_joined(a.first, b.last) || b.first <= a.last ||
            b.first - a.last >= 6)
            return false;
        const bool is_parallel = a.type == BridgeType::parallel;
        const Ladder& before = is_parallel ? a : b;
        const Ladder& behind = is_parallel ? b : a;
        if (!are_joined(std::min(a.other_first, b.other_first),
                        std::max(a.other_last, b.other_last)) ||
            behind.other_first < before.other_last)
            return false;
        const std::size_t across = behind.other_first - before.other_last;
        return (across < 6 && b.first - a.last < 3) || across < 3;
    }

    /// Joins ladders that bulges separate. Those that others have taken have no bridges meanwhile.
    void join() {
        for (std::size_t a = 0; a < ladders_.size(); ++a)
            for (std::size_t b = a + 1; b < ladders_.size(); ++b) {
                Ladder &ladder = ladders_[a], &other = ladders_[b];
                if (ladder.bridges == 0) break;
                if (other.bridges == 0) continue;
                if (other.first >= ladder.last + 6) break; // as all behind
                if (!has_bulge(ladder, other)) continue;
                ladder.last = other.last;
                ladder.other_first = std::min(ladder.other_first, other.other_first);
                ladder.other_last = std::max(ladder.other_last, other.other_last);
                ladder.bridges += std::exchange(other.bridges, 0);
            }
        std::erase_if(ladders_, [](const Ladder& ladder) { return ladder.bridges == 0; });
    }

    const HydrogenBonds& bonds_;
    const std::vector<std::size_t>& piece_of_;
    std::vector<Ladder> ladders_;
    std::size_t first_open_ = 0;
};

} // namespace

std::vector<Strand> strands_of(const HydrogenBonds& bonds,
                               const std::vector<std::size_t>& piece_of) {
    std::vector<Strand> strands;
    for (const Ladder& ladder : Ladders(bonds, piece_of).find()) {
        const bool is_single = ladder.bridges == 1;
        strands.push_back({ladder.first, ladder.last, is_single});
        strands.push_back({ladder.other_first, ladder.other_last, is_single});
    }
    return strands;
}

} // namespace raylane::scenes
