#pragma once

#include "core/hierarchy/binary_tree.hpp"
#include "core/hierarchy/item.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace raylane::core {

/// Builds the subtree over a few items by the surface-area heuristic over all splits between
/// neighbours. The leaves fill up, because the cost counts blocks. Sorts once along each axis; the
/// halves of a split stay sorted.
class Sweep {
  public:
    static constexpr int most_items = 128;

    /// Builds the subtree below node `root` of `nodes`, whose bounds must be set. `first` is the
    /// index of the first item among all items of the tree. Rearranges the items' positions, but
    /// not their bounds, into the order of the leaves.
    EntryCosts build(std::span<Item> items, std::size_t first, std::vector<BinaryNode>& nodes,
                     std::uint32_t root);

  private:
    using Index = std::uint8_t;
    /// Number of blocks that the first or last i items need.
    using BlockCounts = std::array<std::uint8_t, most_items + 1>;

    struct Split {
        float cost = std::numeric_limits<float>::infinity();
        int axis = -1; ///< -1: split by kind
        int middle = 0;
        Box4 left{}, right{};
        Kind kind{}; ///< of the left half, if split by kind
    };

    void sort(int axis, const Box4& centers);
    EntryCosts grow(int first, int last, std::uint32_t node);
    EntryCosts leaf(int first, int last, std::uint32_t node);
    Split best_split(int first, int last, float unit);
    Split best_split_by_kind(int first, int last, float unit);
    bool has_several_kinds(int first, int last) const;
    void count_blocks(int axis, int first, int last);
    void divide(int first, const Split& split, int last);

    std::span<const Item> items_;
    std::size_t first_ = 0;
    std::vector<BinaryNode>* nodes_ = nullptr;
    bool mixed_ = false;
    std::array<std::array<Index, most_items>, 3> order_; // by centre along each axis
    std::array<Box4, most_items> right_boxes_;
    BlockCounts blocks_before_, blocks_from_;
    std::array<bool, most_items> is_left_;
};

} // namespace raylane::core
