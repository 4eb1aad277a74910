#pragma once

#include "core/scene/scene.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace raylane::core {

/// Features that a scene needs of a renderer. A feature that is false need not exist in the
/// renderer's loop.
struct Features {
    bool bounded_shapes = false; ///< needs a hierarchy
    bool planes = false;
    bool solids = false;         ///< compound solids
    bool doubles = false;        ///< shapes with numbers that are not floats
    bool smooth_normals = false; ///< smooth triangles
    bool patterns = false;       ///< colours other than solid
    bool shading = false;        ///< diffuse or specular light; needs shadow rays
    bool soft_light = false;     ///< lights with a size; needs many rays to each
    bool lens = false;           ///< camera rays start at different points
    bool highlights = false;     ///< specular light
    bool reflection = false;     ///< needs reflected rays
    bool fresnel = false;        ///< a reflected fraction that depends on the angle
    bool refraction = false;  ///< transmissive materials; needs refracted rays and tinted shadows
    bool absorption = false;  ///< inside of transmissive materials
    bool transparent = false; ///< opacities below 1; needs rays that continue straight on
    bool fog = false;
    bool spectrum = false;      ///< one image for each of several wavelengths
    bool one_sided = false;     ///< surfaces that are visible from one side only
    bool supersampling = false; ///< more than one sample per pixel

    /// Returns all features with their names, in words.
    std::array<std::pair<std::string_view, bool>, 19> named() const;
};

/// Returns the features of a scene. Only materials of shapes count. `settings` may differ from the
/// scene's own.
Features features_of(const Scene& scene, const Settings& settings);

} // namespace raylane::core
