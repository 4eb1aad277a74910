#pragma once

#include "core/scene/pattern_place.hpp"

namespace raylane::core {

/// Returns the colour of a pattern that is_on_surface(): of an image, or of the part that a face
/// cuts there. The part has the point inside, and the smallest power of such parts: the squared
/// distance from a sphere's centre or a capped cylinder's axis minus the squared radius, and 0 for
/// other shapes. Parts with a cutaway pattern do not count. If powers are equal, the first part
/// counts. The colour is the first one of the pattern outside of all parts, and for a part whose
/// pattern depends on more than the point.
Vec3d color_on(const Scene& scene, const Pattern& pattern, const SurfacePlace& surface);

} // namespace raylane::core
