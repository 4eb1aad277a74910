#pragma once

#include "core/scene/surroundings.hpp"
#include "scenes/json/value.hpp"

/// Contents of a scene file besides materials and objects. These functions do not check what
/// core::SceneBuilder does.
namespace raylane::scenes {

void read_image(const JsonValue& value, core::Settings& settings);
void read_sampling(const JsonValue& value, core::Settings& settings);
void read_limits(const JsonValue& value, core::Settings& settings);
core::Outline read_outline(const JsonValue& value);
core::Camera read_camera(const JsonValue& value);
core::Fog read_fog(const JsonValue& value);
core::Light read_light(const JsonValue& value);

} // namespace raylane::scenes
