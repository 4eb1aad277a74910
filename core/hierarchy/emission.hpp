#pragma once

#include "core/hierarchy/binary_tree.hpp"
#include "core/hierarchy/hierarchy.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

namespace raylane::core {

/// Returns bounds wider by an ulp, so that no shape touches them.
Bounds padded(Bounds bounds);

/// Wide nodes and blocks that are being filled.
class Emission {
  public:
    Emission() = default;
    /// `size`: the number of nodes and of blocks of each kind. `has_doubles`: by kind.
    Emission(const Tally& size, const std::array<bool, kind_count>& has_doubles);

    BigArray<WideNode> nodes;
    template <class Shape>
    Blocks<Shape>& blocks() {
        return std::get<Blocks<Shape>>(blocks_);
    }

  private:
    template <class AnyTables>
    struct BlocksOf;
    template <class... Shapes>
    struct BlocksOf<std::tuple<Table<Shapes>...>> {
        using type = std::tuple<Blocks<Shapes>...>;
    };

    BlocksOf<Tables>::type blocks_;
};

/// Returns the size of a tree that takes one entry of a wide node. Call it before emit().
Tally size_of(TreePart& tree, int node_width, Workers& workers);

/// Turns a tree of a forest into wide nodes with padded bounds, following its nodes' decisions, and
/// its leaves into blocks of the lists' shapes. Numbers both by their position in the tree. `next`
/// holds the index of the next wide node and of the next block of each kind.
Child emit(BinaryForest& forest, std::size_t tree, const ShapeLists& lists, Workers& workers,
           Tally& next, Emission& to);

/// Emits a forest of one tree as a whole hierarchy.
Emission emit_all(BinaryForest& forest, const ShapeLists& lists,
                  const std::array<bool, kind_count>& has_doubles, Workers& workers);

} // namespace raylane::core
