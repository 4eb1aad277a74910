#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace raylane::scenes {

/// A bond from an atom to an image of another one, or of itself, in a cell as many edges away.
struct PeriodicBond {
    AtomIndex a, b;
    std::array<int, 3> cell;
    std::uint8_t order = 1;
};

/// The bonds of a periodic structure, each from both of its ends, by ascending `a`.
class PeriodicBonds {
  public:
    explicit PeriodicBonds(std::vector<PeriodicBond> bonds, std::size_t atoms);
    std::span<const PeriodicBond> of(AtomIndex atom) const {
        return std::span(bonds_).subspan(first_[atom], first_[atom + 1] - first_[atom]);
    }

  private:
    std::vector<PeriodicBond> bonds_;
    std::vector<std::size_t> first_; // by atom, and one more
};

/// Finds bonds in the same way as find_bonds(), also to atoms of other cells, along the edges on
/// which the cell is periodic. Returns nothing for a cell without a volume, with an edge longer
/// than 1e6 angstrom, or so small or flat that its atoms have thousands of images within the length
/// of a bond.
std::optional<PeriodicBonds> periodic_bonds(const Structure& structure,
                                            std::size_t* crowded_atoms = nullptr,
                                            std::vector<char>* is_metallic = nullptr);

/// An atom, moved by a number of edges.
struct AtomCopy {
    AtomIndex atom;
    std::array<int, 3> cell;
};

/// How the atoms of a crystal fill its cells.
struct CrystalLook {
    std::array<int, 3> repeat = {1, 1, 1};
    bool boundary = true; ///< atoms on a face, edge or corner are on all equivalent ones
    bool whole = true;    ///< molecules are not cut at faces
};

/// Returns the atoms in a block of cells, cell by cell. Atoms are moved into the first cell along
/// its periodic edges. With `whole`, a molecule is moved as one, such that the mean of its
/// positions is in the cell; a molecule is a finite set of bonded atoms. With `boundary`, atoms and
/// molecules within 0.05 angstrom of a face of the first cell are on the opposite face of the
/// block, too.
std::vector<AtomCopy> fill_cells(const Structure& structure, const PeriodicBonds& bonds,
                                 const CrystalLook& look);

/// Adds the missing neighbours of the copies of some atoms. `is_center`: 1 for these, by atom.
void add_neighbours(const PeriodicBonds& bonds, const std::vector<char>& is_center,
                    std::vector<AtomCopy>& copies);

/// The copies of atoms as a structure with its bonds. Its atoms have positions and kinds only.
struct CrystalAtoms {
    Structure structure;
    std::vector<AtomIndex> originals; ///< of each atom
    std::vector<Bond> bonds;          ///< sorted
};
CrystalAtoms atoms_of(const Structure& structure, const PeriodicBonds& bonds,
                      const std::vector<AtomCopy>& copies);

} // namespace raylane::scenes
