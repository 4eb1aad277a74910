#pragma once

#include "core/scene/scene.hpp"

namespace raylane::core {

/// Returns the description of a scene's solid: unions, intersections, differences and clips of
/// solids that have an inside. A part has a material only if it differs from the whole's.
Solid description_of(const Scene& scene, Solids::Index solid);

/// Returns the shape of a part as it was given, except for the box of a quadric.
PartShape shape_of_part(const Scene& scene, const Solids::Node& part);

} // namespace raylane::core
