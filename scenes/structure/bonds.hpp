#pragma once

#include "scenes/structure/structure.hpp"

#include <cstddef>
#include <vector>

namespace raylane::scenes {

inline constexpr std::size_t most_bonds = 24; ///< of an atom, which the file does not have

/// Bonds between atoms that are nearer to each other than the sum of their covalent radii and 0.4
/// angstrom, and farther apart than 0.4 (of what are two places for one atom), together with those
/// that the file has, which keep their orders; sorted. Atoms of no known element, and metals with
/// each other, have no bonds but the file's; neither have crowded atoms, which would have more than
/// `most_bonds`, counting atoms that are nearer than 0.4 angstrom. So the time is linear in the
/// atoms even where they lie on top of each other. `crowded_atoms`, if there is one, is left with
/// how many atoms are crowded.
std::vector<Bond> find_bonds(const Structure& structure, std::size_t* crowded_atoms = nullptr);

} // namespace raylane::scenes
