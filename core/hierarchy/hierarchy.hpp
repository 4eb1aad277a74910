#pragma once

#include "core/hierarchy/duplicates.hpp"
#include "core/hierarchy/workers.hpp"
#include "core/shapes/bounds.hpp"
#include "core/shapes/shape_list.hpp"
#include "core/shapes/shape_table.hpp"

#include <cstdint>
#include <vector>

namespace raylane::core {

/// A reference in a node's entry: empty, or to another node, or to a block of shapes of one kind.
class Child {
  public:
    static constexpr std::uint32_t max_index = (1U << 27) - 1;

    constexpr Child() = default;
    static constexpr Child node(std::uint32_t index) { return Child(index); }
    static constexpr Child block(Kind kind, std::uint32_t index) {
        return Child(leaf_bit | static_cast<std::uint32_t>(kind) << 27 | index);
    }

    constexpr bool empty() const { return bits_ == none; }
    constexpr bool is_block() const { return (bits_ & leaf_bit) != 0; }
    constexpr Kind kind() const { return static_cast<Kind>(bits_ >> 27 & 0xF); }
    constexpr std::uint32_t index() const { return bits_ & max_index; }

  private:
    static_assert(kind_count <= 15, "none would be a block of the 16th kind, of four bits");
    static constexpr std::uint32_t leaf_bit = 1U << 31;
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    constexpr explicit Child(std::uint32_t bits) : bits_(bits) {}

    std::uint32_t bits_ = none;
};

/// Up to 16 children with their bounds, structure of arrays: axis a of entry i is lower[a][i]. The
/// bounds are closed and contain all of the child's shapes. Filled entries come first; an empty one
/// has lower > upper.
///
/// Drawing: bench/drawings/node_and_block.svg
struct alignas(64) WideNode {
    float lower[3][block_size];
    float upper[3][block_size];
    Child children[block_size];

    WideNode();
    Bounds bounds(int entry) const;
    /// Returns the bounds of all entries.
    Bounds bounds() const;
    void set(int entry, const Bounds& bounds, Child child);
};

/// Bounding volume hierarchy over the bounded shapes of a scene. Its leaves are the blocks of the
/// scene's tables. It does not contain planes.
struct Hierarchy {
    BigArray<WideNode> nodes; ///< the root first; empty without bounded shapes
    Bounds bounds;            ///< bounds of all its shapes
    /// The cost of each node when its subtree was built (see Refit). Empty: as the bounds are now.
    std::vector<float> built_costs;

    std::size_t bytes() const {
        return nodes.bytes() + built_costs.capacity() * sizeof(built_costs.front());
    }
};

/// Returns the hierarchy with these nodes.
Hierarchy hierarchy_of(BigArray<WideNode> nodes);

/// Builds the hierarchy by the binned surface-area heuristic, whose cost counts blocks of 16 rather
/// than shapes, and collapses the binary tree into wide nodes. Fills the tables: each leaf is one
/// block, and each set of duplicates has one shape. The result depends on the shapes and on the
/// workers' node_width() alone. No shape touches its bounds; rays bring the tolerance for a
/// traversal's rounding errors.
Hierarchy build_hierarchy(const ShapeLists& lists, const Duplicates& duplicates, Workers& workers,
                          Tables& tables);

} // namespace raylane::core
