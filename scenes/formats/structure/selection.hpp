#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// Returns 1 for each atom that an expression selects, and 0 for the others. Words are whole words,
/// in any case except for names of chains and types:
///   all, none, protein, nucleic, polymer (both), water, hetero, hydrogen, noh
///   helix, strand          by the file, or by DSSP's hydrogen bonds
///   backbone, sidechain    of protein
///   ligand                 residues with carbon, except water and parts of polymers
///   ion                    residues of one atom, except water
///   metal                  by element
///   chain A B              by the chain's name
///   residue ALA 17 20-30   by its name (resn) or number (resi)
///   element C Fe
///   name CA CB             by the atom's name
///   type 1 2               by its label in the file
///   index 1-100            by its place in the file, from 1
///   PROPERTY < 3           or <=, >, >=, =, by x, y, z or a column of numbers: b_factor, ...
///   within 5 of ...        at most 5 angstrom from any atom that ... selects, including these;
///                          exwithin: without them
///   byres ...              whole residues of which ... selects an atom
///   not ..., ... and ..., ... or ..., ( ... )
/// PyMOL's and VMD's other words for these are understood, too: solvent, organic, elem, resname,
/// resid, beta, "resi 20-30+40", "20 to 30", "... around 5", "... within 5 of ...", "same residue
/// as ...", !, & and |.
/// "and" binds more tightly than "or", "not" and "within" more tightly than both. Throws BadInput
/// for `option`, with the column, for an invalid expression. `unmatched` receives a message for
/// each name in a list that no atom has.
std::vector<char> select_atoms(const Structure& structure, std::string_view expression,
                               std::vector<std::string>& unmatched,
                               const std::string& option = "--select");

} // namespace raylane::scenes
