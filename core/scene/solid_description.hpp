#pragma once

#include "core/scene/scene.hpp"

namespace raylane::core {

/// A solid of a scene as it can be described: by unions, intersections, differences and clips of
/// what has an inside. Parts have materials of their own where these are not the whole's.
Solid description_of(const Scene& scene, Solids::Index solid);

} // namespace raylane::core
