#pragma once

#include "scenes/formats/structure/cartoon/path.hpp"
#include "scenes/formats/structure/cartoon/shapes.hpp"

namespace raylane::scenes {

/// Adds the bases of drawn nucleotides: a box around the rings of each, and a rod from C1' or the
/// base to the nearest point of the backbone's path. Returns the number of drawn nucleotides with
/// less than six atoms of rings, which get no box.
std::size_t add_bases(const Structure& structure, const Segment& segment, const Path& path,
                      const IsDrawn& is_drawn, const AddShape& add);

} // namespace raylane::scenes
