#pragma once

#include "core/scene/outline.hpp"

#include <cstdint>
#include <limits>

/// Contents of a scene besides its shapes: lights, fog, the camera, and the settings of the
/// picture.
namespace raylane::core {

/// A light casts shadows; what it is itself is not seen. A point or a directional light has no size
/// and does not fade with distance. Of the others `color` is the radiance, in all directions and of
/// both sides: a surface shows as much of it as these fill of the hemisphere above it, by the
/// cosine of their angle to it. Light from all over the sky shows like one light without a size
/// from straight above.
struct Light {
    LightKind kind = LightKind::point;
    Vec3f position{0.0F}; ///< point, sphere, disc: the middle; rectangle: a corner
    /// directional: where the light travels to; sky: the same from the zenith; disc: its normal.
    /// Any length but zero.
    Vec3f direction{0.0F, -1.0F, 0.0F};
    Color color{1.0F};              ///< >= 0; sky: of the zenith
    float radius = 1.0F;            ///< sphere, disc: > 0
    Vec3f edge_u{1.0F, 0.0F, 0.0F}; ///< rectangle: from the corner along its edges, which are
    Vec3f edge_v{0.0F, 0.0F, 1.0F}; ///< perpendicular
    Color ground{1.0F}; ///< sky: the color of the nadir, >= 0; in between it changes evenly
    /// sky: what is farther away than that, > 0, does not shade a surface from it.
    float reach = std::numeric_limits<float>::infinity();
};

/// Fog of fraction f in [0, 1]: a segment shows (1 - f) * colour + f * fog colour. It acts on every
/// segment outside of a transmissive object, secondary rays included. A ray that hits nothing is
/// infinitely long.
struct Fog {
    FogKind kind = FogKind::none;
    Color color{1.0F};
    float start = 0.0F;   ///< in units of length
    float end = 1.0F;     ///< differs from start; for linear, 0 <= start < end
    float density = 0.0F; ///< per unit of length, > 0
};

enum class Projection : std::uint8_t { perspective, orthographic };

struct Camera {
    Projection projection = Projection::perspective;
    Vec3f from{0.0F, 0.0F, 5.0F};
    Vec3f at{0.0F};             ///< differs from `from`
    Vec3f up{0.0F, 1.0F, 0.0F}; ///< not along the line of sight
    float field_of_view =
        45.0F; ///< perspective: degrees from the picture's lower to its upper edge, in (0, 180)
    float height = 2.0F; ///< orthographic: of the picture, > 0, in units of length
    /// Of a thin lens around `from` that all rays of a pixel's point go through, in units of
    /// length; 0: a pinhole, and all is sharp.
    float lens_radius = 0.0F;
    /// From the lens to the plane that is sharp, along the line of sight, in units of length; 0: it
    /// goes through `at`.
    float focus_distance = 0.0F;
};

enum class Transfer : std::uint8_t { srgb, linear };

enum class SamplePattern : std::uint8_t {
    regular,    ///< the centres of the cells
    stratified, ///< a point in each cell, by a hash of pixel and sample
};

/// What of its surroundings a pixel shows, and with which weight.
enum class PixelFilter : std::uint8_t {
    box,             ///< its own square, all of it alike
    gaussian,        ///< of deviation 1/2 pixel, cut off 1.5 pixels from the middle
    blackman_harris, ///< Harris' window of four terms, 3 pixels wide
};

/// Settings that a scene has for its picture; every value can be overridden when it is rendered.
struct Settings {
    int width = 512;  ///< pixels
    int height = 512; ///< pixels
    int grid = 1;     ///< samples per pixel: grid x grid
    SamplePattern samples = SamplePattern::regular;
    /// Decibels of the picture's PSNR against a converged one, 10 to 80, that samples are taken
    /// for, pixel by pixel, in place of `grid`; 0: each pixel has the samples of `grid`.
    float quality = 0.0F;
    PixelFilter filter = PixelFilter::box;
    /// Rays to each light with a size, from each point that a sample sees; 0: light_rays() says;
    /// hard_light: one to its middle, and a sky that nothing shades.
    int light_samples = 0;
    Transfer transfer = Transfer::srgb; ///< from linear RGB to 8 bits
    /// The film has an alpha: where the camera sees the background, past everything or straight
    /// through see-through surfaces, it is left out, with the fog before it. Mirrors and glass show
    /// it, and cover what is behind them.
    bool alpha = false;
    int max_depth = 8;         ///< reflections and refractions on one path; 0: primary rays alone
    float min_weight = 0.001F; ///< a path is left when its largest throughput is below, in [0, 1]
    /// See-through surfaces that a path shows, one behind the other, at least 1; further ones are
    /// as if they were not there.
    int max_see_through = see_through_limit;
    Outline outline;

    static constexpr int max_size = 65535;                ///< pixels a side
    static constexpr std::int64_t max_pixels = 1LL << 28; ///< 3 GiB of film
    static constexpr int max_grid = 256;
    static constexpr int depth_limit = 1000;
    static constexpr int see_through_limit = 1'000'000;
    static constexpr int max_light_samples = 4096;
    static constexpr int hard_light = -1;

    /// Rays to each light with a size: one for each of a pixel's samples, which are spread over the
    /// light together, but four if it has a single sample.
    int light_rays() const {
        if (light_samples == hard_light) return 1;
        if (light_samples != 0) return light_samples;
        return quality == 0.0F && grid == 1 ? 4 : 1;
    }
};

} // namespace raylane::core
