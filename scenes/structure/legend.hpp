#pragma once

#include "core/shapes/types.hpp"
#include "scenes/structure/drawing.hpp"

#include <string>
#include <vector>

namespace raylane::scenes {

/// What the shapes of a drawing stand for.
struct Legend {
    Structure structure;
    std::vector<AtomPair> atoms_of_shape; ///< by shape id; empty: no file of atoms

    /// "atom 12, CA of ALA 25 in chain A (C)" and the like; empty of what is no atom's.
    std::string of(core::ShapeId shape) const;
};

} // namespace raylane::scenes
