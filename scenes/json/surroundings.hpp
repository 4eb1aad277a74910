#pragma once

#include "core/scene/staging.hpp"
#include "scenes/json/value.hpp"

#include <optional>

/// Contents of a scene file besides materials and objects. These functions do not check what
/// core::SceneBuilder does.
namespace raylane::scenes {

/// Adds a parameter, or notes that it has a mistake.
void read_parameter(std::string_view name, const JsonValue& value, Parameters& parameters);
void read_image(const JsonValue& value, core::Settings& settings);
void read_sampling(const JsonValue& value, core::Settings& settings);
void read_limits(const JsonValue& value, core::Settings& settings);
core::Outline read_outline(const JsonValue& value);
/// Of a camera that finds its place by itself the staging says how.
core::Camera read_camera(const JsonValue& value, core::Staging& staging);
core::Fog read_fog(const JsonValue& value);
/// None: those that the camera brings along.
std::optional<core::Light> read_light(const JsonValue& value);

} // namespace raylane::scenes
