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
/// neighbours: that lets the leaves fill up, because the cost counts blocks. Sorts once along each
/// axis; the halves of a split stay sorted.
class Sweep {
  public:
    static constexpr int most_items = 128;

    /// Below node `root` of `nodes`, whose bounds are set. `first` is that of the leaves' items,
    /// whose positions are put in the leaves' order: their bounds mean nothing then.
    EntryCosts build(std::span<Item> items, std::size_t first, std::vector<BinaryNode>& nodes,
                     std::uint32_t root);

  private:
    using Index = std::uint8_t;
    /// The whole blocks that so many of the items need, from either end.
    using BlockCounts = std::array<std::uint8_t, most_items + 1>;

    struct Split {
        float cost = std::numeric_limits<float>::infinity();
        int axis = -1; ///< none: by kind
        int middle = 0;
        Box4 left{}, right{};
        Kind kind{}; ///< that is left, where there is no axis
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
