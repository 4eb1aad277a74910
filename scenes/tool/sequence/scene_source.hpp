#pragma once

#include "core/scene/scene.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/tool/options/scene_options.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace raylane::scenes {

/// The scenes of several images, one after the other. Functions throw BadInput and SystemRefused.
class SceneSource {
  public:
    SceneSource() = default;
    virtual ~SceneSource() = default;
    SceneSource(const SceneSource&) = delete;
    SceneSource& operator=(const SceneSource&) = delete;

    /// Advances to the next scene and returns the number in its image's name, or nothing at the
    /// end.
    virtual std::optional<std::size_t> next() = 0;
    /// Returns the current scene. `legend`, unless null, receives the meaning of its shapes.
    virtual core::Scene scene(Legend* legend) = 0;
    /// Returns to the start.
    virtual void rewind() = 0;
    /// Returns the maximum number of scenes, or 0 if it is unknown.
    virtual std::size_t count() const = 0;

    /// Fixes the values that are derived from whole frames of atoms, such as the range of colours,
    /// to those of the frames rendered so far.
    virtual void keep_scale() {}
};

/// Returns a source of one scene for each set of parameters.
std::unique_ptr<SceneSource> sweep_of(const std::string& path, const LoadOptions& options,
                                      std::vector<std::map<std::string, double>> parameters);

/// Returns a source of one scene for each of the options' frames in a file of atoms.
std::unique_ptr<SceneSource> trajectory_of(const std::string& path, const LoadOptions& options);

} // namespace raylane::scenes
