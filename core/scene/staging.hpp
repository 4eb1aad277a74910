#pragma once

#include "core/scene/framing.hpp"
#include "core/scene/surroundings.hpp"

#include <optional>
#include <vector>

namespace raylane::core {

class Scene;

/// What of a picture follows from the shapes that are seen in it.
struct Staging {
    std::optional<Framing> framing; ///< by which the camera finds its place; none: it has one
    bool lights = false;            ///< the camera brings a sky and a lamp along
    float depth_cue = 0.0F; ///< how much of the background the farthest has by fog, in [0, 1)
    /// The camera is to go around, and sees all of it from everywhere.
    bool turning = false;

    bool any() const { return framing || lights || depth_cue > 0.0F; }
};

/// What follows from it.
struct View {
    Camera camera;
    Fog fog;
    std::vector<Light> lights; ///< that the camera brings along
};

/// Frame for a scene's camera, in which nothing is as yet.
Frame empty_frame(const Scene& scene, const Staging& staging, const Settings& settings);
/// Includes all of a scene's shapes that have bounds; of solids that are made of others the whole.
void include_shapes(const Scene& scene, Frame& frame);
/// The view of what is in a frame, which may be of several scenes. Throws InvalidValue, field
/// "camera", if that is nothing and the camera is to find its place by it.
View staged(const Scene& scene, const Staging& staging, const Frame& frame);
/// Of this scene alone.
View staged(const Scene& scene, const Staging& staging, const Settings& settings);

/// The view of a camera that has gone around what it looks at, with its lights, about the axis
/// `up`: by so many degrees to its right.
View turned(const View& view, const Vec3f& up, double degrees);

} // namespace raylane::core
