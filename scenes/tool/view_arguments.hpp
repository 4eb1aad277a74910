#pragma once

#include "core/scene/scene.hpp"
#include "scenes/tool/command.hpp"

#include <optional>

namespace raylane::scenes {

/// How a scene is to be seen, other than it says itself.
struct ViewChange {
    std::optional<core::NamedView> way; ///< for a camera that finds its place by it
    std::optional<core::Vec3f> up;
    std::optional<float> zoom, depth_cue;
    bool orthographic = false;
    bool turning = false; ///< the camera will go around

    /// The staging that comes of it, and in `camera` the one that the scene has if it is to keep
    /// it. Throws BadInput.
    core::Staging staging(const core::Scene& scene, core::Camera& camera) const;
};

/// How a scene is seen, with the lights that came with its camera.
core::View view_of(const core::Scene& scene);

/// The scene as it is to be seen in a picture of the settings' size; a camera that finds its place
/// by itself sees all that is in `frame`, if there is one, or else all of the scene. Throws
/// BadInput where that is nothing.
core::Scene seen(core::Scene scene, const ViewChange& change, const core::Settings& settings,
                 const std::optional<core::Frame>& frame = std::nullopt);

struct ViewArguments {
    Argument view, up, zoom, depth_cue;
    bool orthographic = false;

    void add_to(CLI::App& command);
    /// Throws BadInput.
    ViewChange change() const;
};

} // namespace raylane::scenes
