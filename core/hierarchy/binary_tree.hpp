#pragma once

#include "core/hierarchy/collapse.hpp"
#include "core/hierarchy/duplicates.hpp"
#include "core/hierarchy/item.hpp"
#include "core/hierarchy/workers.hpp"
#include "core/shapes/big_array.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

namespace raylane::core {

/// A node of the binary tree over items. Its leaves hold at most block_size items of one kind.
struct BinaryNode {
    Bounds bounds;
    std::uint32_t first; ///< leaf: first item; inner: left child (right child: first + 1)
    std::uint8_t count;  ///< leaf: number of items; inner: 0
    Kind kind;           ///< leaf: kind of all its items
    EntryShares shares;  ///< inner

    bool is_leaf() const { return count != 0; }
};

/// Size of a subtree: its entries, nodes and blocks.
struct Tally {
    int entries = 0; ///< in the wide node that its parent is in
    std::uint32_t nodes = 0;
    std::array<std::uint32_t, kind_count> blocks{};

    Tally& operator+=(const Tally& other) {
        entries += other.entries;
        nodes += other.nodes;
        for (int kind = 0; kind < kind_count; ++kind)
            blocks[kind] += other.blocks[kind];
        return *this;
    }
};

/// Part of the binary tree: a whole subtree, or one inner node whose children are separate parts.
struct TreePart {
    std::vector<BinaryNode> nodes; ///< the root first, children behind parents
    std::unique_ptr<TreePart> left, right;
    Tally left_tally; ///< size of the left part, set by the first traversal
};

/// The positions of items, packed in place into the memory of the items, which are no longer
/// needed.
class Positions {
  public:
    Positions() = default;
    explicit Positions(BigArray<Item> items);

    std::size_t size() const { return memory_.size(); }
    std::uint32_t operator[](std::size_t i) const {
        std::uint32_t position;
        std::memcpy(&position,
                    reinterpret_cast<const std::byte*>(memory_.data()) + i * sizeof position,
                    sizeof position);
        return position;
    }

  private:
    BigArray<Item> memory_;
};

/// Trees, and the items' positions in the order in which leaves refer to them.
struct BinaryForest {
    int node_width; ///< the largest number of children of a wide node
    std::vector<TreePart> trees;
    Positions positions;
};

/// An index of each list of bounded shapes.
using EndsOfLists = std::array<std::size_t, kind_count>;

/// Builds trees by the surface-area heuristic, and decides their collapse into wide nodes. The
/// shapes of tree i end at ends[i], where those of the next tree begin; no tree is empty. A tree
/// has one of each set of its duplicates.
BinaryForest build_binary_forest(const ShapeLists& lists, std::span<const EndsOfLists> ends,
                                 const Duplicates& duplicates, Workers& workers);

} // namespace raylane::core
