#pragma once

#include "core/scene/surroundings.hpp"
#include "scenes/formats/pov/tokens.hpp"

namespace raylane::scenes::pov {

/// All of these begin at the opening brace.
Camera read_camera(Tokens& tokens);
LightSource read_light(Tokens& tokens);
core::Fog read_fog(Tokens& tokens);
Sky read_sky(Tokens& tokens);

/// The part of "global_settings { ... }" that affects an image.
struct GlobalSettings {
    int max_trace_level = 5;
    double adc_bailout = 1.0 / 255.0;
    double ambient_light = 1.0;
};
void read_global_settings(Tokens& tokens, GlobalSettings& settings);

/// A camera's view. The world is mirrored, with z negated, if the image's right is opposite to the
/// right that follows from its up and its direction.
struct View {
    core::Camera camera{};
    bool mirrored = false;
    double aspect = 1.0; ///< width / height of the image
};
View view_of(const Camera& camera, Tokens& tokens, const Place& place);

core::Light light_of(const LightSource& light);

} // namespace raylane::scenes::pov
