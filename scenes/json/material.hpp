#pragma once

#include "core/scene/material.hpp"
#include "scenes/json/value.hpp"

namespace raylane::scenes {

/// Reads what the schema calls a material. Does not check what core::SceneBuilder::add_material
/// checks.
core::Material read_material(const JsonValue& value);

} // namespace raylane::scenes
