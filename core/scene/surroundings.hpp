#pragma once

#include "core/scene/outline.hpp"

#include <cstdint>
#include <limits>

/// Contents of a scene besides its shapes: lights, fog, the camera, and the image's settings.
namespace raylane::core {

/// A light casts shadows but is not visible itself. A point or a directional light has no size and
/// does not fade with distance. The `color` of any other light is its radiance, in all directions
/// and from both sides. A surface shows it by the share of the hemisphere above the surface that
/// the light fills, weighted by the cosine. A sky of one colour shows like a light without a size
/// straight above.
struct Light {
    LightKind kind = LightKind::point;
    Vec3f position{0.0F}; ///< point, sphere, disc: the middle; rectangle: a corner
    /// directional: the direction in which light travels; sky: that of the zenith's light; disc:
    /// its normal. Any length but zero.
    Vec3f direction{0.0F, -1.0F, 0.0F};
    Color color{1.0F};              ///< >= 0; sky: the zenith's
    float radius = 1.0F;            ///< sphere, disc: > 0
    Vec3f edge_u{1.0F, 0.0F, 0.0F}; ///< rectangle: from the corner along its edges, which are
    Vec3f edge_v{0.0F, 0.0F, 1.0F}; ///< perpendicular
    Color ground{1.0F};             ///< sky: the nadir's color, >= 0; linear in between
    /// sky: objects farther away than this distance, > 0, do not shade a surface from it.
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
        45.0F; ///< perspective: degrees from the image's lower to its upper edge, in (0, 180)
    float height = 2.0F; ///< orthographic: height of the image, > 0, in units of length
    /// Radius, in units of length, of a thin lens around `from`, through which all rays of a
    /// pixel's point go. 0: a pinhole; everything is sharp.
    float lens_radius = 0.0F;
    /// Distance from the lens to the plane in focus, along the line of sight, in units of length.
    /// 0: the plane through `at`.
    float focus_distance = 0.0F;
};

enum class Transfer : std::uint8_t { srgb, linear };

enum class SamplePattern : std::uint8_t {
    regular,    ///< the centres of the cells
    stratified, ///< a point in each cell, by a hash of pixel and sample
};

/// The area that a pixel shows, and its weights.
enum class PixelFilter : std::uint8_t {
    box,             ///< the pixel's square, with equal weights
    gaussian,        ///< standard deviation 1/2 pixel, cut off 1.5 pixels from the middle
    blackman_harris, ///< Harris' window of four terms, 3 pixels wide
};

/// Settings of a scene's image; a rendering can override each value.
struct Settings {
    int width = 512;  ///< pixels
    int height = 512; ///< pixels
    int grid = 1;     ///< samples per pixel: grid x grid
    SamplePattern samples = SamplePattern::regular;
    /// The image's PSNR, in decibels, 10 to 80, against a converged one. Pixels get as many samples
    /// as this needs, in place of `grid`. 0: each pixel has the samples of `grid`.
    float quality = 0.0F;
    PixelFilter filter = PixelFilter::box;
    /// Rays to each light with a size, from each point that a sample sees. 0: see light_rays().
    /// hard_light: one ray to the light's middle, and a sky without shadows.
    int light_samples = 0;
    /// False: rays to lights ignore surfaces and media that let light pass.
    bool transparent_shadows = true;
    Transfer transfer = Transfer::srgb; ///< from linear RGB to 8 bits
    /// Gives the film an alpha: where the camera sees the background, past everything or straight
    /// through transparent surfaces, the background and the fog before it are left out. Mirrors and
    /// glass show the background, and count as covering it.
    bool alpha = false;
    int max_depth = 8;         ///< reflections and refractions on one path; 0: primary rays alone
    float min_weight = 0.001F; ///< paths end below this largest throughput, in [0, 1]
    /// Maximum number of transparent surfaces, one behind the other, that a path shows, at least 1;
    /// further ones are ignored.
    int max_transparent = transparent_limit;
    Outline outline;

    static constexpr int max_size = 65535;                ///< pixels on a side
    static constexpr std::int64_t max_pixels = 1LL << 28; ///< 3 GiB of film
    static constexpr int max_grid = 256;
    static constexpr int depth_limit = 1000;
    static constexpr int transparent_limit = 1'000'000;
    static constexpr int max_light_samples = 4096;
    static constexpr int hard_light = -1;

    /// Returns the number of rays to each light with a size. By default it is one for each of a
    /// pixel's samples, which are spread over the light together, or four for a pixel with a single
    /// sample.
    int light_rays() const {
        if (light_samples == hard_light) return 1;
        if (light_samples != 0) return light_samples;
        return quality == 0.0F && grid == 1 ? 4 : 1;
    }
};

} // namespace raylane::core
