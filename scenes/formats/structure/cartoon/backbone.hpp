#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/// The chains of a structure, residue by residue.
namespace raylane::scenes {

inline constexpr AtomIndex no_atom = std::numeric_limits<AtomIndex>::max();

/// The atoms that a chain's path follows from.
enum class BackboneAtom : std::uint8_t { ca, n, c, o, p, o5, c5, c4, c1, o3 };
inline constexpr std::size_t backbone_atom_count = 10;

enum class Polymer : std::uint8_t { none, peptide, nucleic };

struct BackboneResidue {
    std::uint32_t residue = 0; ///< index in Structure::of_residue
    Polymer polymer = Polymer::none;
    std::array<AtomIndex, backbone_atom_count> atoms{}; ///< `no_atom`: missing
    AtomIndex first = no_atom, last = no_atom;          ///< all of its atoms are between these

    AtomIndex atom(BackboneAtom name) const { return atoms[static_cast<std::size_t>(name)]; }
    bool has(BackboneAtom name) const { return atom(name) != no_atom; }
    /// Returns the atom that stands for the residue: CA, or P, or without P the next one along the
    /// chain.
    AtomIndex guide() const;
};

/// Residues of one kind, each bonded to the next one.
using Segment = std::vector<BackboneResidue>;

struct Backbone {
    std::vector<Segment> segments;             ///< in the order of the file
    std::vector<BackboneResidue> without_path; ///< of proteins that lack CA, and the like
};

/// Finds proteins and nucleic acids by the names of their atoms. A residue ends its segment if the
/// next one is further away than a bond: C and N, or O3' and P, by more than 2.5 angstrom. Without
/// these atoms, CA by more than 4.6 angstrom, or P by more than 8.5 angstrom. Residues of the first
/// kinds that HETATM records contain belong to a segment only if they are bonded to others.
Backbone backbone_of(const Structure& structure);

} // namespace raylane::scenes
