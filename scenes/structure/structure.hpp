#pragma once

#include "core/numbers/vector.hpp"
#include "scenes/structure/elements.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

/// Atoms, as files of chemists have them. All lengths are in angstrom.
namespace raylane::scenes {

using AtomIndex = std::uint32_t;

/// What several atoms are alike in: an element, a label of the file's, or a type by number.
struct AtomKind {
    std::string label; ///< as the file has it
    Element element = 0;
};

struct Residue {
    std::string name;        ///< "ALA"
    int number = 0;          ///< as the file has it
    char insertion = ' ';    ///< that tells residues of one number apart
    std::uint32_t chain = 0; ///< index
    bool is_hetero = false;  ///< no part of a polymer, in the words of the PDB
};

struct Bond {
    AtomIndex a, b; ///< a < b
    std::uint8_t order = 1;
};

/// Displacements of an atom as a tensor, in angstrom^2: U11, U22, U33, U12, U13, U23, along the
/// axes that the positions have.
struct Anisotropy {
    AtomIndex atom;
    std::array<float, 6> u;
};

/// The shape of an atom that is no ball: its semi-axes.
struct AtomShape {
    AtomIndex atom;
    std::array<core::Vec3f, 3> axes;
};

/// A number for each atom, as a file has it.
struct AtomProperty {
    std::string name;
    std::vector<float> values;
};

/// Box that is repeated, or that a simulation is in.
struct Cell {
    core::Vec3d origin{0.0};
    std::array<core::Vec3d, 3> edges{}; ///< all zero: there is none
    std::array<bool, 3> periodic = {true, true, true};

    bool any() const { return edges != std::array<core::Vec3d, 3>{}; }
};

/// One frame. Arrays by atom are as long as `positions`, or empty where the file has nothing of it.
struct Structure {
    static constexpr std::size_t most_kinds = 65535;
    static constexpr std::size_t most_atoms = std::numeric_limits<AtomIndex>::max() / 2;

    std::string title;
    std::vector<core::Vec3f> positions;
    std::vector<std::uint16_t> kinds; ///< index
    std::vector<AtomKind> of_kind;
    std::vector<float> radii; ///< >= 0

    std::vector<std::string> names;      ///< "CA", of those that are in residues
    std::vector<std::uint32_t> residues; ///< index
    std::vector<Residue> of_residue;
    std::vector<std::string> chains;

    std::vector<AtomProperty> properties;
    std::vector<Anisotropy> anisotropies; ///< by ascending atom
    std::vector<float> isotropies; ///< mean displacements in angstrom^2 beside tensors; 0: unknown
    std::vector<AtomShape> shapes; ///< of some atoms
    std::vector<Bond> bonds;       ///< those that the file has
    bool has_all_bonds = false;    ///< true: there are no others
    Cell cell;

    std::size_t size() const { return positions.size(); }
    Element element(AtomIndex atom) const { return of_kind[kinds[atom]].element; }
};

} // namespace raylane::scenes
