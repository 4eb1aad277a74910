#pragma once

#include "scenes/structure/structure.hpp"

namespace raylane::scenes {

/// Bonds between atoms that are nearer to each other than the sum of their covalent radii and 0.4
/// angstrom, and farther apart than 0.4 (of what are two places for one atom), together with those
/// that the file has, which keep their orders; sorted. By a grid of cells: in time linear in the
/// atoms. Atoms of no known element, and metals with each other, have no bonds but the file's.
std::vector<Bond> find_bonds(const Structure& structure);

} // namespace raylane::scenes
