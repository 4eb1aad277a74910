#pragma once

#include "core/shapes/shape_table.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

/// Collapses a binary tree into wide nodes at the least expected cost, by dynamic programming
/// (Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
/// BVHs", 2017).
namespace raylane::core {

/// Minimum costs of representing one binary subtree by at most i + 1 entries of a wide node. Costs
/// do not decrease further once there are as many entries as leaves.
struct EntryCosts {
    std::array<double, block_size> cost;
    int useful_entries; ///< number of valid elements of `cost`
    double of(int entries) const { return cost[std::min(entries, useful_entries) - 1]; }
};

/// Decision at an inner node of the binary tree: how many of n entries go to the left child.
class EntryShares {
  public:
    /// Returns the entries of the left child; 1 <= entries <= 16. 0: the subtree takes one entry,
    /// or at most entries - 1.
    int left_of(int entries) const { return static_cast<int>(bits_ >> 4 * (entries - 1) & 0xF); }
    /// Returns the entries of the left child if the subtree becomes a separate wide node, with all
    /// entries.
    int left_of_own() const { return static_cast<int>(bits_ & 0xF); }

  private:
    friend EntryCosts collapse(double, const EntryCosts&, const EntryCosts&, int, EntryShares&);

    void set(int entries, int left) { bits_ |= std::uint64_t(left) << 4 * (entries - 1); }

    std::uint64_t bits_ = 0;
};

EntryCosts leaf_costs(double half_area);
/// Returns the costs of an inner node, given its children's costs, and fills in its shares.
/// `node_width`: the largest number of entries in a wide node, at most block_size.
EntryCosts collapse(double half_area, const EntryCosts& left, const EntryCosts& right,
                    int node_width, EntryShares& shares);

} // namespace raylane::core
