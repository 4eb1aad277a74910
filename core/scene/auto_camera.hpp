#pragma once

#include "core/scene/fit_camera.hpp"
#include "core/scene/surroundings.hpp"

#include <optional>
#include <vector>

namespace raylane::core {

class Scene;

/// Which parts of the view are computed from the visible shapes.
struct AutoCamera {
    std::optional<FitCamera> fit_camera; ///< how the camera finds its position; none: it is given
    bool lights = false;                 ///< adds a sky and a lamp that move with the camera
    float depth_cue = 0.0F; ///< fog of the background's color at the far end, in [0, 1)
    /// The camera will go around the shapes, and must see all of them from everywhere.
    bool turning = false;

    bool any() const { return fit_camera || lights || depth_cue > 0.0F; }
};

/// The result of an automatic camera.
struct View {
    Camera camera;
    Fog fog;
    std::vector<Light> lights; ///< that move with the camera
};

/// Returns an empty frame for a scene's camera.
Frame empty_frame(const Scene& scene, const AutoCamera& auto_camera, const Settings& settings);
/// Includes all bounded shapes of a scene; of compound solids, the whole.
void include_shapes(const Scene& scene, Frame& frame);
/// Returns the view of the contents of a frame, which may come from several scenes. Throws
/// InvalidValue, field "camera", if the frame is empty and the camera has to find its position by
/// it.
View staged(const Scene& scene, const AutoCamera& auto_camera, const Frame& frame);
/// Returns the view of this scene alone.
View staged(const Scene& scene, const AutoCamera& auto_camera, const Settings& settings);

/// Returns the view of a camera that has gone around its target, with its lights, about the axis
/// `up`, by an angle to its right.
View turned(const View& view, const Vec3f& up, double degrees);

} // namespace raylane::core
