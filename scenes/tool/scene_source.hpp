#pragma once

#include "core/scene/scene.hpp"
#include "scenes/scene_file.hpp"
#include "scenes/tool/frame_arguments.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace raylane::scenes {

/// Scenes of several pictures, one after the other. Functions throw BadInput and SystemRefused.
class SceneSource {
  public:
    SceneSource() = default;
    virtual ~SceneSource() = default;
    SceneSource(const SceneSource&) = delete;
    SceneSource& operator=(const SceneSource&) = delete;

    /// Goes on to the next one, and returns the number by which its picture goes; nothing if there
    /// are no more.
    virtual std::optional<std::size_t> next() = 0;
    /// The scene of this one.
    virtual core::Scene scene() = 0;
    /// Begins again.
    virtual void rewind() = 0;
    /// How many there are at most; 0: who knows.
    virtual std::size_t count() const = 0;

    /// From now on what follows from a frame of atoms as a whole follows from those that have been
    /// drawn so far.
    virtual void keep_scale() {}
};

/// One for each set of parameters.
std::unique_ptr<SceneSource> sweep_of(const std::string& path, const LoadOptions& options,
                                      std::vector<std::map<std::string, double>> parameters);

/// One for each of these frames of a file of atoms.
std::unique_ptr<SceneSource> trajectory_of(const std::string& path, const LoadOptions& options,
                                           const FrameRange& range);

} // namespace raylane::scenes
