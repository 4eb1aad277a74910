#pragma once

#include "core/scene/auto_camera.hpp"
#include "scenes/formats/json/value.hpp"

#include <optional>

/// Readers of a scene file's contents other than materials and objects. These functions leave the
/// checks of core::SceneBuilder to it.
namespace raylane::scenes {

/// Adds a parameter, or marks it as invalid.
void read_parameter(std::string_view name, const JsonValue& value, Parameters& parameters);
core::Outline read_outline(const JsonValue& value);
/// Reads a camera. If it finds its place by itself, sets `auto_camera` instead.
core::Camera read_camera(const JsonValue& value, core::AutoCamera& auto_camera);
core::Fog read_fog(const JsonValue& value);
/// Returns nothing for the lights that the camera brings along.
std::optional<core::Light> read_light(const JsonValue& value);

} // namespace raylane::scenes
