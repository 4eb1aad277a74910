#pragma once

#include "core/shapes/big_array.hpp"
#include "core/shapes/material_indices.hpp"
#include "core/shapes/shape_table.hpp"
#include "core/solids/solids.hpp"

#include <cstddef>
#include <cstdint>

namespace raylane::core {

/// Finds out whether some spheres are duplicates. Takes linear time.
class EqualSpheres {
  public:
    /// `slots`: lanes of all blocks.
    explicit EqualSpheres(std::size_t slots);

    /// Adds the spheres of the blocks from `first` to `last` - 1, except parts of solids.
    void add(const Blocks<Sphere>& blocks, std::size_t first, std::size_t last,
             const MaterialIndices& material_of, const Solids& solids);
    /// Returns true if some of the spheres are duplicates, and hardly ever if none are.
    bool may_be_any() const { return may_be_any_; }

  private:
    int bits_;
    BigArray<std::uint32_t> seen_; // a hash table; 0: free
    bool may_be_any_ = false;
};

} // namespace raylane::core
