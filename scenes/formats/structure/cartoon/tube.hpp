#pragma once

#include "scenes/formats/structure/cartoon/path.hpp"
#include "scenes/formats/structure/cartoon/shapes.hpp"

namespace raylane::scenes {

/// Adds a round tube along the spline through a path's points, as capped cylinders with spheres
/// where they meet. Consecutive cylinders differ by less than 5 degrees in direction, except in
/// turns of more than 160 degrees between two points.
void add_tube(const Path& path, double radius, const IsDrawn& is_drawn, const AddShape& add);

/// Adds a straight cylinder between consecutive points, half of it for each, and spheres at the
/// points.
void add_trace(const Path& path, double radius, const IsDrawn& is_drawn, const AddShape& add);

} // namespace raylane::scenes
