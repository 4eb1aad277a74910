#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace raylane::scenes {

inline constexpr std::size_t max_bonds = 24; ///< of an atom, besides the file's bonds

/// Returns the file's bonds, which keep their orders, and bonds that are found by distance; sorted.
/// Two atoms are bonded if they are nearer to each other than the sum of their covalent radii and
/// 0.4 angstrom, and farther apart than 0.4 angstrom: nearer positions are two places of one atom.
///
/// Two metal atoms are bonded if they are nearer than 1.1 times the sum of their metallic radii and
/// both elements are metallic. An element is metallic if its atoms have, on average, at least one
/// metal atom so near without an atom of another kind between them: one that is no metal, and
/// nearer to both than they are to each other. So ions of salts and oxides are not bonded to each
/// other, even if their bonds to the anions are too long to be found: Cs in CsSnCl3 has Cl at 3.9
/// angstrom and Cs at 5.6. A cluster in a solvent keeps its bonds.
///
/// Some atoms have only the file's bonds:
/// - atoms of unknown elements;
/// - crowded atoms, which would have more than `max_bonds`, counting atoms nearer than 0.4
///   angstrom.
///
/// So the time is linear in the atoms even if they lie on top of each other. `crowded_atoms`, if
/// given, receives the number of crowded atoms, and `is_metallic` 1 for each element that is
/// metallic.
///
/// `originals`: the last atoms of the structure are images of these atoms in other cells. Bonds of
/// two images are omitted, and averages are those of the originals.
std::vector<Bond> find_bonds(const Structure& structure, std::size_t* crowded_atoms = nullptr,
                             std::vector<char>* is_metallic = nullptr,
                             std::span<const AtomIndex> originals = {});

/// Returns the largest distance at which atoms of the structure may be bonded, in angstrom.
float longest_bond(const Structure& structure);

} // namespace raylane::scenes
