#pragma once

#include "scenes/formats/structure/cartoon/hydrogen_bonds.hpp"

#include <cstddef>
#include <vector>

namespace raylane::scenes {

/// One strand of a ladder of bridges in beta sheets, or a residue of a single bridge.
struct Strand {
    std::size_t first, last;
    bool is_single = false; ///< of a single bridge
};

/// Returns both strands of each ladder. `piece_of` has for each residue the number of the piece of
/// a chain without a break that it belongs to, ascending. Bridges form ladders, and ladders are
/// joined across bulges, as by DSSP 4.
std::vector<Strand> strands_of(const HydrogenBonds& bonds,
                               const std::vector<std::size_t>& piece_of);

} // namespace raylane::scenes
