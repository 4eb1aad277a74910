#pragma once

#include "scenes/formats/structure/cartoon/path.hpp"
#include "scenes/formats/structure/cartoon/ribbon.hpp"

namespace raylane::scenes {

/// Adds a path like add_ribbon(), with a cylinder for each helix of at least four residues: along
/// its axis, which is fitted to the means of four consecutive points. A bent helix gets several
/// cylinders that meet, so that no mean is further than 1 angstrom from an axis.
void add_with_cylinders(const Path& path, const RibbonSizes& sizes, double max_error,
                        const IsDrawn& is_drawn, const AddShape& add);

} // namespace raylane::scenes
