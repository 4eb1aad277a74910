#pragma once

#include "core/shapes/bounds.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <cstdint>
#include <vector>

namespace raylane::scenes {

/// A k-d tree of atoms, which tells whether any of them is near a point.
class AtomTree {
  public:
    AtomTree(const std::vector<core::Vec3f>& positions, const std::vector<AtomIndex>& atoms);

    /// Returns whether an atom is no farther from a point than `reach`. Distances are rounded as
    /// those of two atoms are: sums of squares of floats.
    bool has_within(const core::Vec3f& point, float reach) const;

  private:
    struct Node {
        core::Bounds bounds;      // of its atoms
        std::uint32_t begin, end; // in points_
        std::uint32_t second = 0; // half, or 0 for a leaf; the first half is the next node
    };

    std::uint32_t build(std::uint32_t begin, std::uint32_t end);

    std::vector<core::Vec3f> points_;
    std::vector<Node> nodes_; // the root first, none without atoms
};

} // namespace raylane::scenes
