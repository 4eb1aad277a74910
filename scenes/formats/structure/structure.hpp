#pragma once

#include "core/numbers/vector.hpp"
#include "scenes/formats/structure/elements.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

/// Atoms, as in files of chemistry. All lengths are in angstrom.
namespace raylane::scenes {

using AtomIndex = std::uint32_t;

/// A property that several atoms share: an element, a label of the file, or a type by number.
struct AtomKind {
    std::string label; ///< as in the file
    Element element = 0;
};

/// The secondary structure of a residue. Helices are of any kind.
enum class Secondary : std::uint8_t { coil, helix, strand };

struct Residue {
    std::string name;                      ///< "ALA"
    int number = 0;                        ///< as in the file
    char insertion = ' ';                  ///< distinguishes residues of one number
    std::uint32_t chain = 0;               ///< index
    bool is_hetero = false;                ///< not part of a polymer, in the terms of the PDB
    Secondary secondary = Secondary::coil; ///< in the file
};

struct Bond {
    static constexpr std::uint8_t aromatic = 4;

    AtomIndex a, b;         ///< a < b
    std::uint8_t order = 1; ///< 1, 2, 3 or aromatic
};

/// Displacements of an atom as a tensor, in angstrom^2: U11, U22, U33, U12, U13, U23, along the
/// axes of the positions.
struct Anisotropy {
    AtomIndex atom;
    std::array<float, 6> u;
};

/// The semi-axes of an atom that is not a ball.
struct AtomShape {
    AtomIndex atom;
    std::array<core::Vec3f, 3> axes;
};

/// A number of the file for each atom.
struct AtomProperty {
    std::string name;
    std::vector<float> values;
};

/// A box that is repeated, or that contains a simulation.
struct Cell {
    core::Vec3d origin{0.0};
    std::array<core::Vec3d, 3> edges{}; ///< all zero: no cell
    std::array<bool, 3> periodic = {true, true, true};

    bool any() const { return edges != std::array<core::Vec3d, 3>{}; }
};

/// One frame. Arrays by atom are as long as `positions`, or empty if the file lacks the data.
struct Structure {
    static constexpr std::size_t max_kinds = 65535;
    static constexpr std::size_t max_atoms = std::numeric_limits<AtomIndex>::max() / 2;

    std::string title;
    std::vector<core::Vec3f> positions;
    std::vector<std::uint16_t> kinds; ///< index
    std::vector<AtomKind> of_kind;
    std::vector<float> radii; ///< >= 0

    std::vector<std::string> names;      ///< such as "CA"
    std::vector<std::uint32_t> residues; ///< index
    std::vector<Residue> of_residue;
    std::vector<std::string> chains;
    bool has_secondary = false; ///< the file has the secondary structure of its residues

    std::vector<AtomProperty> properties;
    std::vector<Anisotropy> anisotropies; ///< by ascending atom
    std::vector<float> isotropies;        ///< in angstrom^2, of atoms without a tensor; 0: unknown
    std::vector<AtomShape> shapes;        ///< of atoms that are not balls
    std::vector<Bond> bonds;              ///< of the file
    bool has_all_bonds = false;           ///< true: there are no others
    Cell cell;
    bool is_crystal = false; ///< its cells are drawn as those of crystals unless options change it

    std::size_t size() const { return positions.size(); }
    Element element(AtomIndex atom) const { return of_kind[kinds[atom]].element; }
};

} // namespace raylane::scenes
