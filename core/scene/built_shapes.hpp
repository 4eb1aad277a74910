#pragma once

#include "core/hierarchy/hierarchy.hpp"
#include "core/hierarchy/workers.hpp"
#include "core/scene/staging.hpp"
#include "core/shapes/material_indices.hpp"
#include "core/shapes/shape_table.hpp"

#include <cstddef>
#include <vector>

namespace raylane::core {

/// What takes time to build of a scene without solids that are made of others, for a builder to
/// take as it was built before.
struct BuiltShapes {
    Tables tables;
    MaterialIndices material_of;   ///< by shape id
    std::vector<IdRange> polygons; ///< of more than one triangle, ascending
    Hierarchy hierarchy;
    Staging staging; ///< by which camera, fog and lights have been found
    std::size_t own_light_count = 0;
};

/// The hierarchy that has these nodes.
Hierarchy hierarchy_of(BigArray<WideNode> nodes);

/// Holds all of it, wherever it comes from, to what a builder makes: shapes that are none, numbers
/// of what is not there, a hierarchy that is no tree or does not have each shape in its bounds.
/// Throws InvalidValue, without a field, for the first of them.
void check(const BuiltShapes& shapes, std::size_t material_count, Workers& workers);

} // namespace raylane::core
