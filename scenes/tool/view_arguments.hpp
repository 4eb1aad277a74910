#pragma once

#include "core/scene/scene.hpp"
#include "scenes/tool/command.hpp"

#include <optional>

namespace raylane::scenes {

/// Changes to the view that a scene requests.
struct ViewChange {
    std::optional<core::NamedView> way; ///< for a camera that finds its place
    std::optional<core::Vec3f> up;
    std::optional<float> zoom, depth_cue;
    bool orthographic = false;
    bool turning = false; ///< the camera will turn around the scene

    /// Returns the scene's staging with these changes. If the scene keeps its own camera, changes
    /// are made to `camera` instead. Throws BadInput.
    core::Staging staging(const core::Scene& scene, core::Camera& camera) const;
};

/// Returns a scene's camera and fog, and the lights that came with the camera.
core::View view_of(const core::Scene& scene);

/// Returns the scene with its view in a picture of the settings' size. A camera that finds its
/// place by itself sees everything in `frame`, or the whole scene if `frame` is not set. Throws
/// BadInput if that is empty.
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
