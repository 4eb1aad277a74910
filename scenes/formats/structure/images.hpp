#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <vector>

namespace raylane::scenes {

/// Returns the positions of a cell's images, side by side along its edges, in angstrom. The first
/// is the cell itself.
std::vector<core::Vec3d> offsets_of_images(const Cell& cell, const std::array<int, 3>& repeat);

/// Returns the atoms of all these images, one image after the other, with their positions and
/// kinds, by which bonds are found. Each of the file's bonds joins the nearest images of its atoms,
/// as in simulations, and is omitted if one of these is missing. A cell that is not periodic along
/// an edge has no images beyond it.
Structure with_images(const Structure& structure, const std::array<int, 3>& repeat);

} // namespace raylane::scenes
