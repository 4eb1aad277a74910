#pragma once

#include "core/hierarchy/hierarchy.hpp"
#include "core/hierarchy/workers.hpp"
#include "core/scene/auto_camera.hpp"
#include "core/shapes/material_indices.hpp"
#include "core/shapes/shape_table.hpp"

#include <cstddef>
#include <vector>

namespace raylane::core {

/// The parts of a scene that take time to build, for a builder that takes them as they were built
/// before. The scene must not have compound solids.
struct BuiltShapes {
    Tables tables;
    MaterialIndices material_of;   ///< by shape id
    std::vector<IdRange> polygons; ///< polygons of more than one triangle, ascending
    MergedShapes merged;           ///< shapes that are not in the tables
    Hierarchy hierarchy;
    AutoCamera auto_camera; ///< produced the camera, fog and lights
    std::size_t own_light_count = 0;
};

/// Checks that untrusted shapes are such as a builder makes: shapes are valid, indices are in
/// range, and the hierarchy is a tree with each shape in its bounds. Throws InvalidValue, without a
/// field, for the first fault.
void check(const BuiltShapes& shapes, std::size_t material_count, Workers& workers);

} // namespace raylane::core
