#pragma once

#include "core/shapes/shape_table.hpp"

#include <array>
#include <cstdint>

/// Collapse of a binary tree into wide nodes at the least expected cost, by dynamic programming
/// (Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
/// BVHs", 2017).
namespace raylane::core {

/// For one binary subtree: the least cost of representing it by at most i + 1 slots of a wide node.
/// It does not get less beyond as many slots as there are leaves.
struct SlotCosts {
    std::array<double, block_size> cost;
    int useful_slots; ///< that many are filled in
    double of(int slots) const { return cost[std::min(slots, useful_slots) - 1]; }
};

/// Decision at an inner node of the binary tree: how many of n slots go to the left child.
class SlotShares {
  public:
    /// 1 <= slots <= 16. 0: the subtree takes one slot, or no more than slots - 1.
    int left_of(int slots) const { return static_cast<int>(bits_ >> 4 * (slots - 1) & 0xF); }
    /// If the subtree becomes a wide node of its own, with all 16 slots.
    int left_of_own() const { return static_cast<int>(bits_ & 0xF); }

  private:
    friend SlotCosts collapse(double, const SlotCosts&, const SlotCosts&, SlotShares&);

    void set(int slots, int left) { bits_ |= std::uint64_t(left) << 4 * (slots - 1); }

    std::uint64_t bits_ = 0;
};

SlotCosts leaf_costs(double half_area);
/// Of an inner node, by its children's.
SlotCosts collapse(double half_area, const SlotCosts& left, const SlotCosts& right,
                   SlotShares& shares);

} // namespace raylane::core
