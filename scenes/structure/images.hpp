#pragma once

#include "scenes/structure/structure.hpp"

#include <array>
#include <vector>

namespace raylane::scenes {

/// Where the images of a cell are, side by side along its edges, in angstrom; the first is the
/// cell.
std::vector<core::Vec3d> offsets_of_images(const Cell& cell, const std::array<int, 3>& repeat);

/// Atoms of all these images, one image after the other, with what bonds are found by: positions
/// and kinds; and with the bonds of the file, of which each joins the nearest images of its atoms,
/// as simulations have it, or is left out where these are not both there. A cell that is not
/// periodic along an edge has none beyond it.
Structure with_images(const Structure& structure, const std::array<int, 3>& repeat);

} // namespace raylane::scenes
