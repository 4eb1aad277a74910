#pragma once

#include "core/scene/auto_camera.hpp"
#include "core/scene/surroundings.hpp"
#include "core/shapes/invalid_value.hpp"

#include <string>

/// Checks all values of a scene except shapes. All functions throw InvalidValue.
namespace raylane::core {

void validate(const Pattern& pattern);
void validate(const Material& material);
void validate(const Light& light);
void validate(const Fog& fog);
void validate(const Camera& camera);
/// Checks a camera that finds its position, and the depth cue that comes with it.
void validate(const AutoCamera& auto_camera);
void validate(const Outline& outline);
void validate(const Settings& settings);

/// Checks a colour: components >= 0.
void validate_color(const char* field, const Color& color);

/// Checks a value whose fields begin with `place` in messages.
template <class Value>
void validate_in(const std::string& place, const Value& value) {
    try {
        validate(value);
    } catch (const InvalidValue& invalid) {
        throw InvalidValue(place + "/" + invalid.field, invalid.expectation);
    }
}

} // namespace raylane::core
