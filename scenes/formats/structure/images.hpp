#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <optional>
#include <vector>

namespace raylane::scenes {

/// Returns vectors whose products with a position relative to the cell's origin are the position's
/// fractions along the edges; nothing for a cell without a volume.
std::optional<std::array<core::Vec3d, 3>> reciprocal_edges(const Cell& cell);

/// Returns the sum of a number of edges in each direction.
core::Vec3d offset_in(const Cell& cell, const std::array<int, 3>& cells);

/// Returns the distance, in cells along each edge, to the image of `b` that is nearest to `a`.
std::array<int, 3> cells_between(const Cell& cell, const core::Vec3d& a, const core::Vec3d& b);

/// Returns the positions of a cell's images, side by side along its edges, in angstrom. The first
/// is the cell itself.
std::vector<core::Vec3d> offsets_of_images(const Cell& cell, const std::array<int, 3>& repeat);

/// Returns the atoms of all these images, one image after the other, with their positions and
/// kinds, by which bonds are found. Each of the file's bonds joins the nearest images of its atoms,
/// as in simulations, and is omitted if one of these is missing. A cell that is not periodic along
/// an edge has no images beyond it.
Structure with_images(const Structure& structure, const std::array<int, 3>& repeat);

} // namespace raylane::scenes
