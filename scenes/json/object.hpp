#pragma once

#include "core/scene/scene.hpp"
#include "scenes/json/value.hpp"

#include <functional>

namespace raylane::scenes {

/// The material that the value of a key "material" means.
using MaterialOf = std::function<core::MaterialIndex(const JsonValue& value)>;

/// Adds what the schema calls an object: a shape, or all shapes of a generator.
void add_object(const JsonValue& object, core::SceneBuilder& builder,
                const MaterialOf& material_of);

} // namespace raylane::scenes
