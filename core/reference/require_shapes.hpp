#pragma once

#include "core/scene/scene.hpp"

#include <string>

namespace raylane::core {

/// Throws InvalidValue, field "scene", if a scene keeps copies of groups. `query`: the one
/// that needs shapes in their place.
inline void require_shapes(const Scene& scene, const std::string& query) {
    if (scene.copies() != nullptr)
        throw InvalidValue("scene", "must not keep copies of groups for " + query +
                                        "; build() it with shapes in their place");
}

} // namespace raylane::core
