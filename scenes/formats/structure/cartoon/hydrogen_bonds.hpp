#pragma once

#include "core/numbers/vector.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace raylane::scenes {

/// The atoms of a residue that its hydrogen bonds follow from, in angstrom.
struct PeptideAtoms {
    core::Vec3d n, ca, c, o;
    bool is_proline = false;
    bool follows = false; ///< bonded to the one before in the list
};

/// The two strongest hydrogen bonds that each residue's N-H donates.
class HydrogenBonds {
  public:
    /// Kabsch and Sander, "Dictionary of protein secondary structure" (1983): charges of 0.42 e on
    /// C and O, of 0.20 e on N and H. H is 1 angstrom from N, opposite to the C=O before it.
    /// Residues whose CA are 9 angstrom or more apart have no bond. Energies are rounded to
    /// 0.001 kcal/mol, as in DSSP.
    explicit HydrogenBonds(const std::vector<PeptideAtoms>& residues);

    /// Returns true if the N-H of one residue is bonded to the C=O of another one, by an energy
    /// below -0.5 kcal/mol.
    bool has(std::size_t donor, std::size_t acceptor) const;

    /// Calls visit(donor, acceptor) for each bond.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (std::size_t donor = 0; donor < best_.size(); ++donor)
            for (const Bonded& bond : best_[donor])
                if (bond.energy < highest_energy) visit(donor, bond.acceptor);
    }

  private:
    static constexpr double highest_energy = -0.5;
    struct Bonded {
        std::size_t acceptor = 0;
        double energy = 0.0;
    };
    void add(std::size_t donor, std::size_t acceptor, double energy);

    std::vector<std::array<Bonded, 2>> best_; // by donor
};

} // namespace raylane::scenes
