#pragma once

#include "core/hierarchy/hierarchy.hpp"

#include <cstdint>
#include <vector>

namespace raylane::core {

/// Fits the bounds of a hierarchy to blocks of spheres that have moved, and finds the nodes whose
/// subtrees are worth a rebuild.
///
/// The cost of a node is that of the builder's surface-area heuristic: the expected number of nodes
/// and blocks in its subtree that a ray visits if it meets the node's bounds. A node is worn if its
/// entries have grown so much relative to it that its cost exceeds that of the build by max_growth.
/// Each child counts with its cost of the build, so that it is worn by itself.
class Refit {
  public:
    /// `spheres`: the bounds of each block of spheres.
    Refit(const Hierarchy& old, const BigArray<Bounds>& spheres);

    /// Returns the highest worn nodes, in the order of the hierarchy.
    std::vector<std::uint32_t> worn_nodes() const;
    /// Returns the hierarchy with its new bounds.
    Hierarchy take();

  private:
    BigArray<WideNode> nodes_;
    std::vector<float> built_costs_;
    std::vector<bool> is_worn_;
};

inline constexpr float unknown_cost = -1.0F;
/// Computes the unknown costs of nodes; those behind the end of `costs` are unknown.
void add_costs(const BigArray<WideNode>& nodes, std::vector<float>& costs);

} // namespace raylane::core
