#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/tachyon/shading.hpp"

#include <optional>

/// Contents of a Tachyon scene other than its objects.
namespace raylane::scenes {

struct TachyonFog {
    enum class Falloff : std::uint8_t { linear, exponential, squared };
    Falloff falloff = Falloff::linear;
    float start = 0.0F, end = 1.0F, density = 1.0F;
    core::Color color{1.0F};
};

struct TachyonCamera {
    core::Projection projection = core::Projection::perspective;
    float zoom = 1.0F;
    int antialiasing = 0; ///< samples of a pixel in addition to the first
    int ray_depth = 6;
    core::Vec3f center{0.0F}, direction{0.0F, 0.0F, -1.0F}, up{0.0F, 1.0F, 0.0F};
    float aperture = 0.0F; ///< PERSPECTIVE_DOF: the lens' diameter
    bool has_frustum = false;
    float bottom = 0.0F, top = 0.0F; ///< FRUSTUM, at distance 1
};

TachyonCamera read_camera(TachyonWords& words);
/// Reads the statement after FOG; returns nothing for OFF.
std::optional<TachyonFog> read_fog(TachyonWords& words);
/// Read the statements after LIGHT, DIRECTIONAL_LIGHT and SPOTLIGHT.
core::Light read_point_light(TachyonWords& words);
core::Light read_directional_light(TachyonWords& words);
core::Light read_spotlight(TachyonWords& words);
/// Reads the statement after BACKGROUND_GRADIENT. Returns the colour of its middle.
core::Color read_background_gradient(TachyonWords& words);

/// Sets the camera, and the settings that follow from it.
void set_camera(core::SceneBuilder& builder, const TachyonCamera& camera);
void set_fog(core::SceneBuilder& builder, const TachyonFog& fog, const TachyonCamera& camera,
             bool planar, TachyonWords& words);

} // namespace raylane::scenes
