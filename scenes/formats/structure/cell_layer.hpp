#pragma once

#include "core/scene/fit_camera.hpp"
#include "scenes/formats/structure/atom_layer.hpp"

#include <vector>

namespace raylane::scenes {

/// Returns a direction of view that shows the edges of a cell: c upward, a to the viewer and
/// slightly to the left, from slightly above. The cell has a volume.
core::NamedView view_of_cell(const Cell& cell);

/// Adds the edges of all cells, as thin as 0.2 % of the extent of all.
void add_cell_edges(const DrawnAtoms& atoms, core::SceneBuilder& builder,
                    std::vector<AtomPair>* atoms_of_shape);

/// Adds arrows along the edges a (red), b (green) and c (blue) of the cell, at the lower left of
/// all atoms as the camera sees them. Their materials have the names "axis a", "axis b" and "axis
/// c".
void add_axes(const DrawnAtoms& atoms, const core::FitCamera& camera, core::SceneBuilder& builder,
              std::vector<AtomPair>* atoms_of_shape);

} // namespace raylane::scenes
