#pragma once

#include "scenes/formats/structure/atom_layer.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace raylane::scenes {

/// Returns the faces of the convex hull of at most 64 points, as indices, counter-clockwise from
/// outside. Points within 0.05 angstrom of a face's plane are on it. Points of one plane have one
/// face; points of one line have none.
std::vector<std::vector<std::size_t>> hull_of(std::span<const core::Vec3d> points);

/// Adds the polyhedra around a layer's atoms: the convex hulls of the atoms bonded to each, if
/// these are 4 to 64, in the colour of the atom, with dark edges. Those that planes cut have
/// faces on the planes. Returns the number of polyhedra.
std::size_t add_polyhedra_layer(const DrawnAtoms& atoms, const AtomLayer& layer,
                                DrawnShapes& shapes);

} // namespace raylane::scenes
