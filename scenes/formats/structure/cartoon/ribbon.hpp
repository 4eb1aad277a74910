#pragma once

#include "scenes/formats/structure/cartoon/path.hpp"
#include "scenes/formats/structure/cartoon/shapes.hpp"

namespace raylane::scenes {

/// Half of the widths and thicknesses of ribbons, in angstrom.
struct RibbonSizes {
    double coil = 0.22; ///< the radius of round tubes
    double helix_width = 1.25, helix_thickness = 0.22;
    double strand_width = 1.15, strand_thickness = 0.24, arrow_width = 1.9;
};

/// Adds a path as triangles: coils as round tubes, helices as ribbons with round edges, strands as
/// ribbons with square edges and an arrow. Coils and helices are one surface without a seam. The
/// distance of triangles from the surface is about `max_error` at most, in angstrom. Their normals
/// are those of the surface, from its derivatives, in double. Only pieces whose atoms are drawn are
/// added, each with closed ends.
void add_ribbon(const Path& path, const RibbonSizes& sizes, double max_error,
                const IsDrawn& is_drawn, const AddShape& add);

} // namespace raylane::scenes
