#pragma once

#include "raylane/api.hpp"
#include "raylane/vector.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace raylane::core {
class Texture;
}
namespace raylane::library {
struct Internals;
}

namespace RAYLANE_API raylane {

enum class PatternKind : std::uint8_t {
    solid,
    checker,
    stripes,
    gradient,
    formula,
    image,
    cutaway, ///< on a face that cuts a solid, the colour of the part that it cuts there
};

/// Coordinates of the points of a pattern.
enum class PatternSpace : std::uint8_t {
    world,
    object, ///< those in which a shape was given, before transforms and placements moved it
};

/// Colours beyond the edges of an image.
enum class ImageWrap : std::uint8_t {
    repeat, ///< those of further copies of the image
    clamp,  ///< those of the nearest edge
};

/// An image as the colour of surfaces, see Pattern::image. Copies share the pixels. read_texture()
/// reads a file.
class Texture {
  public:
    Texture() = default; ///< no image
    /// Take height x width x 3 components: rows from the top down, red, green and blue of each
    /// pixel; as codes of the sRGB curve, or as linear numbers from 0 to 1e10. An image has 1 to
    /// 67,108,864 pixels. Throw InvalidValue, field "image".
    Texture(int width, int height, std::span<const std::uint8_t> srgb);
    Texture(int width, int height, std::span<const float> linear);

    bool any() const { return texture_ != nullptr; }
    int width() const;  ///< pixels; 0 without an image
    int height() const; ///< pixels; 0 without an image
    /// Returns the linear colour of the pixel in column x from the left and row y from the top.
    /// Throws InvalidValue, field "image", for another place.
    Color pixel(int x, int y) const;

    /// Returns true for the same pixels.
    friend bool operator==(const Texture& a, const Texture& b);

  private:
    friend struct library::Internals;

    std::shared_ptr<const core::Texture> texture_;
};

/// A text for each channel of a colour. Not an array: with one as a member, g++ 12 stops in
/// templates that write Material{}.
struct ChannelTexts {
    std::string red, green, blue;

    static constexpr std::size_t size() { return 3; }
    std::string& operator[](std::size_t channel) {
        return channel == 0 ? red : channel == 1 ? green : blue;
    }
    const std::string& operator[](std::size_t channel) const {
        return channel == 0 ? red : channel == 1 ? green : blue;
    }
    friend bool operator==(const ChannelTexts&, const ChannelTexts&) = default;
};

/// Colour as a function of the point in space, or an image on the surface. A part that cuts others
/// of its solid can have their colours (cutaway). If several parts are around a point, the sphere
/// or capped cylinder with the smallest power gives the colour, and the first one of equals. The
/// power is the squared distance from the centre or the axis minus the squared radius. A part whose
/// colour depends on more than the point gives the first of `colors`.
struct Pattern {
    PatternKind kind = PatternKind::solid;
    /// >= 0. solid, cutaway: the first colour only. checker, stripes: alternating, with the first
    /// colour in the cell that begins at the origin. gradient: the colours at `from` and at `to`.
    /// Others: unused.
    Color colors[2] = {{1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F}};
    /// > 0. checker: edge length of a cell; stripes: width of a band. A point nearer to an edge
    /// than 2^-29 of this size belongs to the cell that begins there, or, for an upper edge in
    /// `axes`, to the cell that ends there.
    float size = 1.0F;
    /// checker: a bit for each axis along which the colour alternates, at least one
    /// (x 1, y 2, z 4), and a bit for each axis along which a cell contains its upper edge instead
    /// of its lower one (x 8, y 16, z 32). A floor uses x and z, because its constant y may be an
    /// edge.
    std::uint8_t axes = 1 | 4;
    /// stripes: direction across the bands, of any length except zero.
    Vec3 direction{1.0F, 0.0F, 0.0F};
    /// gradient: start and end points, which differ; the colour is constant beyond them.
    Vec3 from{};
    Vec3 to{0.0F, 1.0F, 0.0F};
    /// formula: the texts of red, green and blue, such as "abs(cos(x))", at most 10,000 bytes each,
    /// in the language that scenes/README.md describes. Together they may have 64 different
    /// operations. A result that is undefined or below 0 counts as 0, above 1e10 as 1e10.
    ChannelTexts formula{};
    /// checker, stripes, gradient, formula: coordinates of the points. In object space a pattern
    /// moves with its shapes when Group::transformed, Solid::transformed and placements move them.
    /// The coordinates u and v of a formula are then those in object space, too.
    PatternSpace space = PatternSpace::world;
    /// image: between the four nearest pixels, in linear light. Its lower left corner is at u = 0
    /// and v = 0, coordinates on the shape in object space that scenes/README.md describes. One
    /// copy extends over `width` along u and `height` along v, > 0. On spheres, ellipsoids,
    /// cylinders and cones no colours blend across v = 0 and v = 1. A quadric has one colour, and
    /// so have planes, open cylinders and open cones that are parts of solids.
    Texture image{};
    float width = 1.0F;
    float height = 1.0F;
    ImageWrap wrap = ImageWrap::repeat;
    /// image: from the lower to the upper pole of spheres and ellipsoids, of any length except
    /// zero.
    Vec3 axis{0.0F, 1.0F, 0.0F};
};

/// Shape of the highlight.
enum class Highlight : std::uint8_t {
    blinn, ///< Blinn's (1977): max(n.h, 0)^exponent
    phong, ///< Phong's (1975): max(r.l, 0)^exponent
};

enum class Reflection : std::uint8_t {
    constant,   ///< `reflectivity` at every angle
    schlick,    ///< Schlick's approximation (1994), computed from `index`
    dielectric, ///< Fresnel's equations for an unpolarised ray, computed from `index`
};

/// Sides from which a surface is visible. Rays, including those of Tracer, pass through the other
/// side without a hit. A shadow ray runs from the surface to the light.
enum class Visible : std::uint8_t { both, outside, inside };

/// Index of refraction of glass by Sellmeier's formula: n^2 = 1 + sum of B_i w^2 / (w^2 - C_i) for
/// a wavelength w in micrometres. If the scene has `wavelengths`, each is rendered with its own
/// index.
struct Sellmeier {
    std::array<double, 3> B{}, C{}; ///< B has no unit; C is in square micrometres
};

/// Optical properties of a surface. A ray that hits the surface shows the colour
///   C ambient + sum_l S L_l (C diffuse max(n.l, 0) + specular max(n.h, 0)^exponent)
///   + R (colour reflected) + (1 - R) transmission (colour transmitted),
/// times `opacity`, plus 1 - opacity times the colour straight behind the surface. The unit vectors
/// are n (normal), l (to the light) and h (halfway between l and the direction to the viewer); for
/// Phong's highlight, n.h stands for r.l with the reflected ray r. L_l
/// is the colour of light l, S the fraction of it that reaches the point, C the pattern's colour
/// and R the reflected fraction.
struct Material {
    Pattern pattern{};
    float ambient = 0.1F;   ///< >= 0
    float diffuse = 0.8F;   ///< >= 0
    float specular = 0.0F;  ///< >= 0, of the highlight, in the light's colour
    float exponent = 32.0F; ///< >= 0
    Highlight highlight = Highlight::blinn;
    Reflection reflection = Reflection::constant;
    float reflectivity = 0.0F; ///< [0, 1]
    float transmission = 0.0F; ///< [0, 1] per crossed surface; 0 is opaque
    float index = 1.5F;        ///< index of refraction, > 0; outside of all shapes it is 1
    /// Replaces `index` if any B is nonzero: the index is then that for 587.56 nm, or for each of
    /// the scene's `wavelengths`.
    Sellmeier glass{};
    /// >= 0, per unit of length inside (Beer and Lambert: exp(-absorption * length)).
    Vec3 absorption{};
    Visible visible = Visible::both;
    /// [0, 1]: the weight of the surface's colour, as of paint on a pane. The scene straight behind
    /// it has the weight 1 - opacity. Unlike transmitted light, it is not refracted, absorbed or
    /// weakened by reflection.
    float opacity = 1.0F;
};

/// The index of a material in its scene: 0, 1, 2, ... in the order in which they were added.
using MaterialIndex = std::uint32_t;

/// The index of no material. A part of a solid takes that of the solid, a member of a group that of
/// the group, and an object of a scene the default one, Material{}.
inline constexpr MaterialIndex no_material = std::numeric_limits<MaterialIndex>::max();

/// Returns the material that files know as a preset: "matte" (the same as Material{}), "plastic",
/// "metal", "mirror", "glass", "water" or "diamond". Throws InvalidValue, field "preset", for
/// another name.
RAYLANE_API Material material_preset(std::string_view name);

/// Returns a glass of the catalogue, for Material::glass: "N-BK7", "N-K5", "N-BAK4", "F2", "N-F2",
/// "SF5", "N-SF5", "N-SF10", "N-SF11", "SF11" (Schott), "fused silica", "calcium fluoride" or
/// "diamond". Throws InvalidValue, field "glass", for another name.
RAYLANE_API Sellmeier catalogue_glass(std::string_view name);

} // namespace raylane
