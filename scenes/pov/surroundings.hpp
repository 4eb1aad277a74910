#pragma once

#include "core/scene/surroundings.hpp"
#include "scenes/pov/tokens.hpp"

namespace raylane::scenes::pov {

/// All of these begin at the brace.
Camera read_camera(Tokens& tokens);
LightSource read_light(Tokens& tokens);
core::Fog read_fog(Tokens& tokens);
Sky read_sky(Tokens& tokens);

/// "global_settings { ... }", as far as a picture has them.
struct GlobalSettings {
    int max_trace_level = 5;
    double adc_bailout = 1.0 / 255.0;
    double ambient_light = 1.0;
};
void read_global_settings(Tokens& tokens, GlobalSettings& settings);

/// What a camera sees: where its picture's right is to the left of what its up and its direction
/// give, the world in a mirror, z against z.
struct View {
    core::Camera camera{};
    bool mirrored = false;
    double aspect = 1.0; ///< of the picture: width by height
};
View view_of(const Camera& camera, Tokens& tokens, const Place& place);

core::Light light_of(const LightSource& light);

} // namespace raylane::scenes::pov
