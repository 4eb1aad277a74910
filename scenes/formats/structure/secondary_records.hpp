#pragma once

#include "scenes/formats/structure/gemmi_files.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <string_view>
#include <vector>

namespace raylane::scenes {

/// Appends the helix or strand of a PDB file's record HELIX or SHEET. Omits incomplete records, and
/// helices of polyproline (class 10).
void read_secondary(std::string_view record, std::vector<gemmi_files::SecondaryRange>& ranges);

/// Sets the secondary structure of residues. A range is the residues from its first to its last in
/// the order of the file. If one of these is missing, it is the residues of its chain with numbers
/// between theirs. Helices take precedence over strands.
void assign_secondary(const std::vector<gemmi_files::SecondaryRange>& ranges, Structure& structure);

} // namespace raylane::scenes
