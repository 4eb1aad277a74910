#pragma once

#include "scenes/formats/structure/structure.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// Returns 1 for each atom that an expression selects, and 0 for the others. Words are whole words,
/// in any case except for names of chains and types:
///   all, none, protein, nucleic, water, hetero, hydrogen, backbone
///   chain A B          by the chain's name
///   residue ALA 17 20-30   by its name or number
///   element C Fe
///   name CA CB         by the atom's name
///   type 1 2           by its label in the file
///   index 1-100        by its place in the file, from 1
///   PROPERTY < 3       or <=, >, >=, =, by a column of numbers: b_factor, occupancy, charge, ...
///   within 5 of ...    at most 5 angstrom from any atom that ... selects, with these atoms
///   not ..., ... and ..., ... or ..., ( ... )
/// "and" binds more tightly than "or", "not" and "within" more tightly than both. Throws BadInput
/// for --select, with the column, for an invalid expression. `unmatched` receives a message for
/// each name in a list that no atom has.
std::vector<char> select_atoms(const Structure& structure, std::string_view expression,
                               std::vector<std::string>& unmatched);

} // namespace raylane::scenes
