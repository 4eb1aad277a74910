#pragma once

#include "core/hierarchy/duplicates.hpp"
#include "core/hierarchy/hierarchy.hpp"
#include "core/hierarchy/workers.hpp"
#include "core/shapes/material_indices.hpp"
#include "core/solids/solids.hpp"

#include <span>
#include <vector>

namespace raylane::core {

/// The shapes of a scene whose spheres move.
struct MovableShapes {
    Tables& tables;
    Hierarchy& hierarchy;
    std::vector<MergedShape>& merged; ///< spheres
    const MaterialIndices& material_of;
    std::span<const IdRange> polygons;
    const Solids& solids;
    bool merge; ///< see Duplicates
};

/// Moves all spheres that are not parts of solids. `coordinates`: x, y and z of their centres, in
/// the order of their ids. Refits the bounds of the hierarchy. Rebuilds the subtrees of nodes whose
/// entries have become too large, and the whole hierarchy if spheres have become equal or
/// different. The result has the shapes of a new scene and does not depend on the workers. Throws
/// InvalidValue, fields "positions" and "positions/17/2", and then changes nothing.
template <class Number>
void move_spheres(std::span<const Number> coordinates, const MovableShapes& shapes,
                  Workers& workers);

} // namespace raylane::core
