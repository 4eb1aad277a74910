#pragma once

#include "raylane/api.h"
#include "raylane/vector.hpp"

#include <cstdint>
#include <limits>

/// Contents of a scene besides its shapes: lights, fog, the camera, and the settings of the
/// picture.
namespace RAYLANE_API raylane {

enum class LightKind : std::uint8_t { point, directional, sky, sphere, disc, rectangle };

/// A light casts shadows; what it is itself is not seen. A point or a directional light has no size
/// and does not fade with distance. Of the others `color` is the radiance, in all directions and of
/// both sides: a diffuse surface shows as much of it as they fill of the hemisphere above it, by
/// the cosine of their angle to it. A sky of one colour that nothing hides is as bright as a light
/// without a size straight above.
struct Light {
    LightKind kind = LightKind::point;
    Vec3 position{}; ///< point: where it is, not on a surface; sphere, disc: middle; rectangle:
                     ///< corner
    /// directional: where the light travels to; sky: the same from the zenith; disc: its normal.
    /// Any length but zero.
    Vec3 direction{0.0F, -1.0F, 0.0F};
    Color color{1.0F, 1.0F, 1.0F}; ///< >= 0; sky: of the zenith
    float radius = 1.0F;           ///< sphere, disc: > 0, in units of length
    Vec3 edge_u{1.0F, 0.0F, 0.0F}; ///< rectangle: from the corner along its edges, which are
    Vec3 edge_v{0.0F, 0.0F, 1.0F}; ///< perpendicular
    Color ground{1.0F, 1.0F,
                 1.0F}; ///< sky: the colour of the nadir, >= 0; in between it changes evenly
    /// sky: what is farther away than that, > 0, does not shade a surface from it.
    float reach = std::numeric_limits<float>::infinity();
};

enum class FogKind : std::uint8_t {
    none,
    linear_z,    ///< by world z: none at z = start, all at z = end
    linear,      ///< by the distance along the ray: none at `start`, all at `end`
    exponential, ///< 1 - exp(-density * distance)
};

/// Fog of fraction f in [0, 1]: a segment shows (1 - f) * colour + f * fog colour. It acts on every
/// segment outside of a transmissive object, secondary rays included. A ray that hits nothing is
/// infinitely long.
struct Fog {
    FogKind kind = FogKind::none;
    Color color{1.0F, 1.0F, 1.0F}; ///< >= 0
    float start = 0.0F;            ///< in units of length
    float end = 1.0F;              ///< differs from start; for linear, 0 <= start < end
    float density = 0.0F;          ///< per unit of length, > 0
};

enum class Projection : std::uint8_t { perspective, orthographic };

struct Camera {
    Projection projection = Projection::perspective;
    Vec3 from{0.0F, 0.0F, 5.0F};
    Vec3 at{};                 ///< differs from `from`
    Vec3 up{0.0F, 1.0F, 0.0F}; ///< not along the line of sight
    /// perspective: degrees from the picture's lower to its upper edge, in (0, 180)
    float field_of_view = 45.0F;
    float height = 2.0F; ///< orthographic: of the picture, > 0, in units of length
    /// Of a thin lens, in units of length, that blurs what is not in focus; 0: a pinhole.
    float lens_radius = 0.0F;
    /// From the lens to the plane that is sharp, in units of length; 0: it goes through `at`.
    float focus_distance = 0.0F;
};

/// Transfer from linear RGB to the 8 bits of a PNG file: the curve of IEC 61966-2-1, or none.
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

/// Lines along the edges of what the camera sees first, over the picture.
struct Outline {
    float width = 0.0F; ///< pixels, at most 32; 0: none
    Color color{};      ///< >= 0
    /// Degrees, 0 to 180, that surfaces which meet are bent by at least where there is a line
    /// between them; there is one between two materials, too. 180: there are none where surfaces
    /// meet, only where one is seen before another.
    float creases = 180.0F;
};

/// Settings that a scene has for its picture.
struct Settings {
    int width = 512;  ///< pixels, 1 to 65535; the picture has at most 2^28
    int height = 512; ///< pixels, 1 to 65535
    int grid = 1;     ///< samples per pixel: grid x grid, 1 to 256
    SamplePattern samples = SamplePattern::regular;
    /// 0, or decibels (PSNR) that the picture is to have against a converged one, 10 to 80: then
    /// each pixel gets the samples that it needs, and `grid` and `samples` do not count.
    float quality = 0.0F;
    PixelFilter filter = PixelFilter::box;
    /// Rays to each light with a size, from each point that a sample sees, 1 to 4096; 0: four if
    /// pixels have one sample, one otherwise; -1: hard light, which is one ray to the middle of
    /// each lamp, and a sky that nothing shades.
    int light_samples = 0;
    Transfer transfer = Transfer::srgb; ///< for write_image
    /// The picture has an alpha: where the camera sees the background, past everything or straight
    /// through surfaces of opacities below 1, it is left out, with the fog before it. Mirrors and
    /// glass show it, and cover what is behind them.
    bool alpha = false;
    int max_depth = 8;         ///< reflections and refractions on one path, 0 to 1000
    float min_weight = 0.001F; ///< a path is left when its largest throughput is below, in [0, 1]
    /// Surfaces of opacities below 1 that a path shows, one behind the other, 1 to 1000000; further
    /// ones are as if they were not there.
    int max_see_through = 1'000'000;
    Outline outline;
};

} // namespace raylane
