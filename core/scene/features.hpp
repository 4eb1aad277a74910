#pragma once

#include "core/scene/scene.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace raylane::core {

/// Features that a scene needs of a renderer. Those that are false need not exist in its loop.
struct Features {
    bool bounded_shapes = false; ///< so a hierarchy to walk
    bool planes = false;
    bool solids = false;         ///< that are made of others
    bool doubles = false;        ///< shapes whose numbers are no floats
    bool smooth_normals = false; ///< smooth triangles
    bool patterns = false;       ///< colours other than solid
    bool shading = false;        ///< diffuse or specular light, so shadow rays
    bool soft_light = false;     ///< lights with a size, so many rays to each
    bool lens = false;           ///< so camera rays that start side by side
    bool highlights = false;     ///< specular light
    bool reflection = false;     ///< so reflected rays
    bool fresnel = false;        ///< a reflected fraction that depends on the angle
    bool refraction = false;     ///< transmissive materials, so refracted rays and tinted shadows
    bool absorption = false;     ///< inside of these
    bool see_through = false;    ///< opacities below 1, so rays that go straight on
    bool fog = false;
    bool spectrum = false;      ///< a picture for each of some wavelengths
    bool one_sided = false;     ///< surfaces that are visible from one side alone
    bool supersampling = false; ///< more than one sample per pixel

    /// Each with its name, in words.
    std::array<std::pair<std::string_view, bool>, 19> named() const;
};

/// Shapes decide which materials are in use. `settings` may differ from the scene's own.
Features features_of(const Scene& scene, const Settings& settings);

} // namespace raylane::core
