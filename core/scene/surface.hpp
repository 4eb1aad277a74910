#pragma once

#include "core/scene/scene.hpp"

namespace raylane::core {

/// The first shape whose surface contains exactly this point, or no_shape.
ShapeId surface_through(const Scene& scene, const Vec3f& point);

} // namespace raylane::core
