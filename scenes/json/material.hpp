#pragma once

#include "core/scene/material.hpp"
#include "scenes/json/value.hpp"

#include <string>

namespace raylane::scenes {

/// Reads what the schema calls a material. Does not check what core::SceneBuilder::add_material
/// checks.
core::Material read_material(const JsonValue& value);

/// Key in the file for a field of core::Material: to core a plain colour is a pattern, too.
std::string key_of_material_field(const std::string& field, core::PatternKind pattern);

} // namespace raylane::scenes
