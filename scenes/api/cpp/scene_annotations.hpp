#pragma once

#include "core/scene/film.hpp"
#include "core/scene/scene.hpp"
#include "raylane/scene.hpp"

#include <filesystem>
#include <functional>

namespace raylane::library {

/// The annotations of a scene of atoms. raylane::trace renders images with them, and only
/// raylane::raylane, which reads atoms, has the code that makes them.
class SceneAnnotations {
  public:
    SceneAnnotations() = default;
    virtual ~SceneAnnotations() = default;
    SceneAnnotations(const SceneAnnotations&) = delete;
    SceneAnnotations& operator=(const SceneAnnotations&) = delete;

    /// Makes the annotations of an image. Returns a function that puts them over its film, which
    /// shows `part`, or into an SVG file, unless its name is empty. Both functions throw the errors
    /// of render().
    virtual std::function<void(core::Film&)>
    of_image(const core::Scene& scene, const core::Settings& settings, const core::Region& part,
             const std::filesystem::path& file, const OnRemark& on_remark) const = 0;
};

} // namespace raylane::library
