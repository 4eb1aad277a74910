#pragma once

#include "core/scene/fit_camera.hpp"
#include "scenes/formats/structure/atom_layer.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// Returns a direction of view that shows the edges of a cell: c upward, a towards the viewer and
/// slightly to the left, from slightly above. The cell has a volume.
core::NamedView view_of_cell(const Cell& cell);

inline constexpr std::array<std::string_view, 3> edge_names = {"a", "b", "c"};

/// Returns the view with an edge of the cell towards the viewer, by its name, and c upward, or b
/// for c. The edge has a length.
core::NamedView view_along_edge(const Cell& cell, std::string_view name);

/// Returns the view along the shortest edge of a block of cells; of edges that are equally long, c
/// precedes b, and b precedes a. The cell has a volume.
core::NamedView best_view_of_cell(const Cell& cell, const std::array<int, 3>& repeat);

/// Adds the edges of all cells, as thin as 0.2 % of the extent of all.
void add_cell_edges(const DrawnAtoms& atoms, DrawnShapes& shapes);

/// Adds arrows along the edges a (red), b (green) and c (blue) of the cell, at the lower left of
/// all atoms as the camera sees them; `radius`: that of the largest atom. Their materials have the
/// names "axis a", "axis b" and "axis c".
void add_axes(const DrawnAtoms& atoms, const core::FitCamera& camera, double radius,
              DrawnShapes& shapes);

} // namespace raylane::scenes
