#pragma once

#include "core/hierarchy/binary_tree.hpp"
#include "core/hierarchy/item.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace raylane::core {

/// Builds the subtree over at most max_items items by the surface-area heuristic. Tries all splits
/// between neighbours along each axis and, for items of several kinds, all splits of one kind from
/// the others. The leaves fill up, because the cost counts blocks. The items are sorted once along
/// each axis, and the halves of a split stay sorted.
class Sweep {
  public:
    static constexpr int max_items = 128;

    /// Builds the subtree below nodes[root], whose bounds must be set, and returns the subtree's
    /// costs. `first` is the index of items[0] among all items of the tree. On return, items[i] has
    /// the Item::position() of the item that is number i in the order of the leaves. The bounds and
    /// kinds of the items keep their order.
    EntryCosts build(std::span<Item> items, std::size_t first, std::vector<BinaryNode>& nodes,
                     std::uint32_t root);

    /// `node_width`: see Workers.
    explicit Sweep(int node_width) : node_width_(node_width) {}

  private:
    using Index = std::uint8_t;
    /// Number of blocks that the first or last i items need.
    using BlockCounts = std::array<std::uint8_t, max_items + 1>;

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

    int node_width_;
    std::span<const Item> items_;
    std::size_t first_ = 0;
    std::vector<BinaryNode>* nodes_ = nullptr;
    bool mixed_ = false;
    std::array<std::array<Index, max_items>, 3> order_; // by centre along each axis
    std::array<Box4, max_items> right_boxes_;
    BlockCounts blocks_before_, blocks_from_;
    std::array<bool, max_items> is_left_;
};

} // namespace raylane::core
