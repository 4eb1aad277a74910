#pragma once

#include "raylane/api.hpp"
#include "raylane/vector.hpp"

#include <cstdint>
#include <limits>
#include <string_view>

/// Contents of a scene besides its shapes: lights, fog, the camera and the image settings.
namespace RAYLANE_API raylane {

enum class LightKind : std::uint8_t { point, directional, sky, sphere, disc, rectangle };

/// A light source. It casts shadows and is invisible itself. Point and directional lights have no
/// size and do not fade with distance. For the other kinds, `color` is the radiance in every
/// direction and on both sides. A diffuse surface shows this radiance times the fraction of the
/// hemisphere above the surface that the light fills. The cosine of the angle to the normal weights
/// this fraction. An unobstructed sky of one colour is as bright as a light without a size straight
/// above the surface.
struct Light {
    LightKind kind = LightKind::point;
    Vec3 position{}; ///< point: its position, not on a surface; sphere, disc: centre; rectangle:
                     ///< corner
    /// directional: direction in which the light travels; sky: direction in which the zenith's
    /// light travels; disc: normal. Any length except zero.
    Vec3 direction{0.0F, -1.0F, 0.0F};
    Color color{1.0F, 1.0F, 1.0F}; ///< >= 0; sky: colour of the zenith
    float radius = 1.0F;           ///< sphere, disc: > 0, in units of length
    Vec3 edge_u{1.0F, 0.0F, 0.0F}; ///< rectangle: the edges from the corner, perpendicular to
    Vec3 edge_v{0.0F, 0.0F, 1.0F}; ///< each other
    Color ground{1.0F, 1.0F,
                 1.0F}; ///< sky: colour of the nadir, >= 0; linear in the height up to the zenith
    /// sky: > 0, in units of length. Shapes farther than this from a surface do not shade it.
    float reach = std::numeric_limits<float>::infinity();
};

enum class FogKind : std::uint8_t {
    none,
    linear_z,    ///< linear in world z: f = 0 at z = start, f = 1 at z = end
    linear,      ///< linear in the distance along the ray: f = 0 at `start`, f = 1 at `end`
    exponential, ///< f = 1 - exp(-density * distance)
};

/// Fog with a fraction f in [0, 1]: a ray segment shows (1 - f) * colour + f * fog colour. Fog acts
/// on every segment outside of transmissive objects, including secondary rays. A ray that hits
/// nothing is infinitely long.
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
    /// perspective: degrees from the image's lower to its upper edge, in (0, 180)
    float field_of_view = 45.0F;
    float height = 2.0F; ///< orthographic: height of the image, > 0, in units of length
    /// Radius of the thin lens, >= 0, in units of length. 0: a pinhole, without depth of field.
    float lens_radius = 0.0F;
    /// Distance from the lens to the plane of focus, >= 0, in units of length. 0: that plane goes
    /// through `at`.
    float focus_distance = 0.0F;
};

/// A camera that SceneBuilder::build places so that it shows all bounded shapes as large as
/// possible.
struct AutoCamera {
    Projection projection = Projection::perspective;
    Vec3 direction{0.0F, 0.0F, -1.0F}; ///< line of sight, of any length except zero
    /// Upward direction in the image, not along the line of sight. Zero: y, or -z if the line of
    /// sight is almost along y.
    Vec3 up{};
    /// perspective: degrees from the image's lower to its upper edge, 0.01 to 179
    float field_of_view = 30.0F;
    float zoom = 1.0F; ///< magnification, 0.01 to 1000; 1: all bounded shapes are visible
    /// Fraction of the background's colour at the farthest shapes, 0 to 0.99, by a fog that
    /// replaces that of the scene. 0: none.
    float depth_cue = 0.0F;
};

/// Returns an automatic camera that sees a scene from the side of this name, as in files: "front"
/// (from +z, the default), "back", "right" (from +x), "left", "top" (from +y), "bottom", "x", "y"
/// (from +x and +y, with z upward), "z" or "corner". Throws InvalidValue, field "view", for another
/// name.
RAYLANE_API AutoCamera named_view(std::string_view name);

/// Transfer from linear RGB to 8 bits: the sRGB curve of IEC 61966-2-1, or none.
enum class Transfer : std::uint8_t { srgb, linear };

enum class SamplePattern : std::uint8_t {
    regular,    ///< the centre of each cell
    stratified, ///< a point in each cell, from a hash of the pixel and the sample
};

/// Reconstruction filter: the weight of the surroundings in a pixel's colour.
enum class PixelFilter : std::uint8_t {
    box,             ///< the pixel's square, with constant weight
    gaussian,        ///< standard deviation 1/2 pixel, cut off 1.5 pixels from the centre
    blackman_harris, ///< Harris' window of four terms, 3 pixels wide
};

/// Lines over the image, along the edges of the first visible surfaces.
struct Outline {
    float width = 0.0F; ///< line width in pixels, 0 to 32; 0: no lines
    Color color{};      ///< >= 0
    /// Degrees, 0 to 180. Surfaces that meet have a line between them if their materials differ or
    /// if the angle between their normals exceeds this one. 180: lines only where one surface is in
    /// front of another.
    float creases = 180.0F;
};

/// Settings of a scene's image.
struct Settings {
    int width = 512;  ///< pixels, 1 to 65535; the image has at most 2^28 pixels
    int height = 512; ///< pixels, 1 to 65535
    int grid = 1;     ///< 1 to 256; each pixel has grid x grid samples
    SamplePattern samples = SamplePattern::regular;
    /// 0, or the PSNR in decibels of the image against a converged one, 10 to 80. Each pixel then
    /// gets the samples that it needs, and `grid` and `samples` are ignored.
    float quality = 0.0F;
    PixelFilter filter = PixelFilter::box;
    /// Shadow rays to each light with a size, from each visible point of a sample, 1 to 4096. 0:
    /// four if a pixel has one sample, one otherwise. -1: hard light, that is, one ray to the
    /// centre of each such light, and an unshadowed sky.
    int light_samples = 0;
    /// False: surfaces of opacity below 1 and glass cast no shadows, and absorb no light on its way
    /// from the lights. An envelope then leaves its contents as bright as they are without it.
    bool transparent_shadows = true;
    Transfer transfer = Transfer::srgb; ///< for write_image
    /// True: the image has an alpha channel. It omits the background, and the fog in front of it,
    /// where the camera sees the background directly or straight through surfaces of opacity below
    /// 1. Mirrors and glass show the background and are opaque in alpha.
    bool alpha = false;
    int max_depth = 8;         ///< reflections and refractions on one path, 0 to 1000
    float min_weight = 0.001F; ///< [0, 1]; a path ends when its largest throughput falls below this
    /// Maximum number of surfaces of opacity below 1 that one path shows, 1 to 1000000. The path
    /// ignores further ones, as if they were not there.
    int max_transparent = 1'000'000;
    Outline outline;
};

} // namespace raylane
