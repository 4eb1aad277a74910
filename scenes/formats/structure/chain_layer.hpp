#pragma once

#include "scenes/formats/structure/atom_layer.hpp"

#include <string>

namespace raylane::scenes {

/// Adds the chains of a layer whose style shows chains, like add_layer(). Returns a message about
/// residues that could not be drawn, or an empty text. `is_only_look`: no other look shows the
/// residues that are not in chains, so the message names them. Throws BadInput if no chain has two
/// residues of the layer.
std::string add_chain_layer(const DrawnAtoms& atoms, const AtomLayer& layer, DrawnShapes& shapes,
                            bool is_only_look);

} // namespace raylane::scenes
