#pragma once

#include "scenes/structure/structure.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// The atoms that an expression selects, 1 or 0 for each. Words are whole words, of any case but
/// for names of chains:
///   all, none, protein, nucleic, water, hetero, hydrogen, backbone
///   chain A B          by the chain's name
///   residue ALA 17 20-30   by its name or number
///   element C Fe
///   name CA CB         of the atom
///   type 1 2           its label in the file
///   index 1-100        by its place in the file, from 1
///   PROPERTY < 3       or <=, >, >=, =, of a column of numbers: b_factor, occupancy, charge, ...
///   within 5 of ...    no farther, in angstrom, from any atom that is selected so; those, too
///   not ..., ... and ..., ... or ..., ( ... )
/// "and" binds more tightly than "or", "not" and "within" more tightly than both. Throws BadInput
/// for `option`, with the column, for what is none. `unmatched`, if there is one, gets a message
/// for each name in a list that no atom has.
std::vector<char> select_atoms(const Structure& structure, const std::string& option,
                               std::string_view expression,
                               std::vector<std::string>* unmatched = nullptr);

} // namespace raylane::scenes
