#pragma once

#include "scenes/formats/tachyon/words.hpp"

#include <cstdint>
#include <optional>

namespace raylane::scenes {

/// Tachyon's shading, set by a scene's SHADER_MODE or overridden by a command line.
struct TachyonShading {
    enum class Quality : std::uint8_t {
        flat,       ///< LOW and LOWEST: colours only
        no_shadows, ///< MEDIUM: no light from the sky either
        full,
    };
    enum class Highlight : std::uint8_t { blinn, phong, none };

    std::optional<Quality> quality;
    std::optional<Highlight> highlight; ///< set by a command line only
    /// TRANS_VMD: the light of a surface is multiplied by its opacity. Otherwise all of it is added
    /// to the light from behind, which is multiplied by the transparency in either case.
    std::optional<bool> weighed_by_opacity;
    /// TRANS_RASTER3D: surfaces are more opaque at oblique angles.
    std::optional<bool> opaque_aslant;
    std::optional<bool> planar_fog; ///< by depth, not by distance
    std::optional<int> max_transparent_surfaces;

    // Light from the whole sky, and the factor of all other light.
    std::optional<core::Vec3f> sky;
    std::optional<float> direct;
    std::optional<int> sky_samples;

    std::optional<int> ray_depth; ///< set by a command line only

    Quality quality_or_full() const { return quality.value_or(Quality::full); }
    /// Returns these settings, with those that are set in `over` in their place.
    TachyonShading overridden_by(const TachyonShading& over) const;
};

/// Returns the sample grid with a number of samples near `antialiasing` + 1 for each pixel.
int grid_of_samples(int antialiasing);

/// Reads the statement after SHADER_MODE.
void read_shader_mode(TachyonWords& words, TachyonShading& shading);

} // namespace raylane::scenes
