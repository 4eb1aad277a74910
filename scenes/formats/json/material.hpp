#pragma once

#include "core/scene/material.hpp"
#include "scenes/formats/json/value.hpp"

#include <string>

namespace raylane::scenes {

/// Reads a material of the schema. Leaves the checks of core::SceneBuilder::add_material to it.
core::Material read_material(const JsonValue& value);

/// Returns the key in the file for a field of core::Material: core stores a plain colour as a
/// pattern.
std::string key_of_material_field(const std::string& field, core::PatternKind pattern);

} // namespace raylane::scenes
