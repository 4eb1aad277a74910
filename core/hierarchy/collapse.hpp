#pragma once

#include "core/shapes/shape_table.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

/// Collapse of a binary tree into wide nodes at the least expected cost, by dynamic programming
/// (Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
/// BVHs", 2017).
namespace raylane::core {

/// Least costs of representing one binary subtree by at most i + 1 entries of a wide node. They do
/// not get less beyond as many entries as there are leaves.
struct EntryCosts {
    std::array<double, block_size> cost;
    int useful_entries; ///< that many are filled in
    double of(int entries) const { return cost[std::min(entries, useful_entries) - 1]; }
};

/// Decision at an inner node of the binary tree: how many of n entries go to the left child.
class EntryShares {
  public:
    /// 1 <= entries <= 16. 0: the subtree takes one entry, or no more than entries - 1.
    int left_of(int entries) const { return static_cast<int>(bits_ >> 4 * (entries - 1) & 0xF); }
    /// Entries of the left child if the subtree becomes a wide node of its own, with all 16.
    int left_of_own() const { return static_cast<int>(bits_ & 0xF); }

  private:
    friend EntryCosts collapse(double, const EntryCosts&, const EntryCosts&, EntryShares&);

    void set(int entries, int left) { bits_ |= std::uint64_t(left) << 4 * (entries - 1); }

    std::uint64_t bits_ = 0;
};

EntryCosts leaf_costs(double half_area);
/// Costs of an inner node, by its children's.
EntryCosts collapse(double half_area, const EntryCosts& left, const EntryCosts& right,
                    EntryShares& shares);

} // namespace raylane::core
