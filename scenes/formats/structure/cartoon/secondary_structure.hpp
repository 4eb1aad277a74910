#pragma once

#include "scenes/formats/structure/cartoon/backbone.hpp"

#include <vector>

namespace raylane::scenes {

/// Returns the secondary structure of each residue of the structure, by index. It is the file's, if
/// the file has one. Otherwise it follows, segment by segment:
/// - from hydrogen bonds, if half of the residues or more have N, CA, C and O. The patterns are
///   those of Kabsch and Sander, "Dictionary of protein secondary structure" (1983), in the order
///   of DSSP 4: ladders are strands; alpha helices replace strands; 3-10 helices are where neither
///   is; pi helices may replace alpha helices. Single bridges are coils.
/// - from the places of CA: Labesse, Colloc'h, Pothier and Mornon, "P-SEA" (1997).
std::vector<Secondary> secondary_structure(const Structure& structure, const Backbone& backbone);

} // namespace raylane::scenes
