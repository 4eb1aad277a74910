#pragma once

#include "core/bounds.hpp"

#include <cstdint>
#include <vector>

namespace raylane::core {

/// One bounded shape, as the builder of the hierarchy sees it.
struct Item {
    Bounds bounds;
    std::uint32_t position; ///< in the table of its kind: block * block_size + lane
    Kind kind;
};

/// A node of the binary tree over items. Its leaves hold at most block_size items of one kind.
struct BinaryNode {
    Bounds bounds;
    std::uint32_t first; ///< leaf: of its items; inner: the left child, the right one is first + 1
    std::uint16_t count; ///< leaf: how many items; inner: 0

    bool is_leaf() const { return count != 0; }
};

/// The tree by the surface-area heuristic, nodes in an order in which children follow parents, the
/// root first. Sorts `items` so that each leaf's stand together. `items` must not be empty.
std::vector<BinaryNode> build_binary_tree(std::vector<Item>& items);

} // namespace raylane::core
