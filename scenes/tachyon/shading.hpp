#pragma once

#include "scenes/tachyon/words.hpp"

#include <cstdint>
#include <optional>

namespace raylane::scenes {

/// How Tachyon shades, as a scene's SHADER_MODE says it or, in its place, a command line.
struct TachyonShading {
    enum class Quality : std::uint8_t {
        flat,       ///< LOW and LOWEST: colours alone
        no_shadows, ///< MEDIUM: nor light from the sky
        full,
    };
    enum class Highlight : std::uint8_t { blinn, phong, none };

    std::optional<Quality> quality;
    std::optional<Highlight> highlight; ///< of a command line alone
    /// TRANS_VMD: what a surface shows is weighed by its opacity. Else what is behind, which is
    /// weighed in any case, is added to all of it.
    std::optional<bool> weighed_by_opacity;
    /// TRANS_RASTER3D: surfaces are the more opaque the more aslant they are seen.
    std::optional<bool> opaque_aslant;
    std::optional<bool> planar_fog; ///< by depth, not by distance
    std::optional<int> most_transparent_surfaces;

    // Light from all over the sky, and what all other light is multiplied by.
    std::optional<core::Vec3f> sky;
    std::optional<float> direct;
    std::optional<int> sky_samples;

    std::optional<int> ray_depth; ///< of a command line alone

    Quality quality_or_full() const { return quality.value_or(Quality::full); }
    /// With what is set in `over` in place of what is set here.
    TachyonShading overridden_by(const TachyonShading& over) const;
};

/// The grid of about as many samples in a pixel as `antialiasing` and one more.
int grid_of_samples(int antialiasing);

/// Reads what is behind SHADER_MODE.
void read_shader_mode(TachyonWords& words, TachyonShading& shading);

} // namespace raylane::scenes
