#pragma once

#include "core/scene/pattern_place.hpp"

namespace raylane::core {

/// Returns the colour of a pattern that is_on_surface(): an image, or that of the part that a face
/// cuts there. The latter is the part of the solid with the point inside and the smallest power:
/// for spheres the squared distance from the centre minus the squared radius, for capped cylinders
/// the same of the axis, for others 0. Of equal powers, the first part counts. Outside of all
/// parts, and where the part's own pattern depends on more than the point, the colour is the first
/// one of the pattern.
Vec3d color_on(const Scene& scene, const Pattern& pattern, const SurfacePlace& surface);

} // namespace raylane::core
