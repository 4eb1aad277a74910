#pragma once

#include "core/scene/scene.hpp"
#include "core/shapes/ray.hpp"

namespace raylane::core {

/// A place on the surface of a shape.
struct SurfacePlace {
    ShapeId shape;
    Kind kind;
    Place place;
    Face face;
    Vec3d point; ///< in the scene
};

/// The place of a point in a pattern.
struct PatternPlace {
    Vec3d point; ///< in the pattern's coordinates
    ShapeCoordinates on_shape;
};

/// Returns the place of a surface in a pattern that needs_shape().
PatternPlace place_in_pattern(const Scene& scene, const Pattern& pattern,
                              const SurfacePlace& surface);

/// Returns the colour of a pattern that is an image.
Vec3d image_at(const Scene& scene, const Pattern& pattern, const SurfacePlace& surface);

} // namespace raylane::core
