#pragma once

#include "core/scene/scene.hpp"

#include <optional>

namespace raylane::core {

/// Returns the first shape whose surface contains exactly this point, or no_shape.
ShapeId surface_through(const Scene& scene, const Vec3f& point);

/// Returns a point on no surface, next to a point that is on one. It is on the camera's side of the
/// first shape, or outside of the shape if that hides the point from the camera. Returns nothing if
/// surfaces are everywhere around.
std::optional<Vec3f> point_beside_surface(const Scene& scene, const Vec3f& point,
                                          const Camera& camera);

} // namespace raylane::core
