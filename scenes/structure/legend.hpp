#pragma once

#include "core/shapes/types.hpp"
#include "scenes/structure/drawing.hpp"

#include <string>
#include <vector>

namespace raylane::scenes {

/// The meaning of a drawing's shapes.
struct Legend {
    Structure structure;
    std::vector<AtomPair> atoms_of_shape; ///< by shape id; empty: not from a file of atoms

    /// Returns "atom 12, CA of ALA 25 in chain A (C)" and the like; empty if the shape is not an
    /// atom's.
    std::string of(core::ShapeId shape) const;
};

} // namespace raylane::scenes
