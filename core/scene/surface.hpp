#pragma once

#include "core/scene/scene.hpp"

#include <optional>

namespace raylane::core {

/// The first shape whose surface contains exactly this point, or no_shape.
ShapeId surface_through(const Scene& scene, const Vec3f& point);

/// A point on no surface, next to one that is on some: on the camera's side of the first shape, or
/// outside of it if the shape hides the point from the camera. Returns nothing where surfaces are
/// everywhere around.
std::optional<Vec3f> point_beside_surface(const Scene& scene, const Vec3f& point,
                                          const Camera& camera);

} // namespace raylane::core
