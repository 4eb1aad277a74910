#pragma once

#include "core/scene/scene.hpp"

namespace raylane::scenes {

/// A solid of a scene as it can be described: by unions, intersections, differences and clips of
/// what has an inside. Parts have materials of their own where these are not the whole's.
core::Solid description_of(const core::Scene& scene, core::Solids::Index solid);

} // namespace raylane::scenes
