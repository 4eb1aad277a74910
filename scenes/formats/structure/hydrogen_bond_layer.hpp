#pragma once

#include "scenes/formats/structure/atom_layer.hpp"

#include <utility>
#include <vector>

namespace raylane::scenes {

/// Finds hydrogen bonds of N, O and F. Returns pairs of atoms: the hydrogen atom, or the donor if
/// the file has no hydrogen, and the acceptor.
///
/// With a hydrogen atom H of a donor D: the distance of H and the acceptor is less than 2.5
/// angstrom, and the angle at H is above 120 degrees (Baker and Hubbard, Prog. Biophys. Mol. Biol.
/// 44, 97, 1984).
///
/// If the structure has no hydrogen atoms bonded to N, O or F: donor and acceptor are less than 3.5
/// angstrom apart, and all angles at them to atoms bonded to them are above 90 degrees. Nitrogen
/// with at most two bonds is a donor, and oxygen with at most one that is longer than 1.3 angstrom;
/// oxygen, fluorine, and nitrogen with at most two bonds are acceptors.
///
/// Atoms that are bonded to the same atom are not a pair. Atoms with more than max_bonds bonds have
/// no hydrogen bonds, so the time for a pair is bounded.
std::vector<std::pair<AtomIndex, AtomIndex>> find_hydrogen_bonds(const Structure& structure,
                                                                 const std::vector<Bond>& bonds);

/// Returns the ends of an odd number of dashes on a line, as long as the gaps between them, about
/// 0.15 angstrom. The gaps at the ends of the line are half as long.
std::vector<std::pair<core::Vec3d, core::Vec3d>> dashes_of(const core::Vec3d& from,
                                                           const core::Vec3d& to);

/// Adds the hydrogen bonds of all visible atoms as dashed lines, if no plane cuts an end off.
/// Returns their number.
std::size_t add_hydrogen_bonds(const DrawnAtoms& atoms, DrawnShapes& shapes);

} // namespace raylane::scenes
