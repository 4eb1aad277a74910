#pragma once

#include "raylane/api.h"
#include "raylane/vector.hpp"

#include <array>
#include <cstdint>

namespace RAYLANE_API raylane {

enum class PatternKind : std::uint8_t { solid, checker, stripes, gradient, back_plane };

/// Colour as a function of the point in space, in world coordinates.
struct Pattern {
    PatternKind kind = PatternKind::solid;
    /// solid: the first. checker, stripes: alternating, the first in the cell that begins at the
    /// origin. gradient: at `from` and at `to`. back_plane: not used. >= 0
    Color colors[2] = {{1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F}};
    /// checker: the cells' edge; stripes: their width. What is nearer than 2^-29 of it to an edge
    /// is of the cell that begins there, unless `axes` says otherwise. > 0
    float size = 1.0F;
    /// checker: which axes count, one or more (x 1, y 2, z 4), and where cells hold their upper
    /// edge, not the lower one (x 8, y 16, z 32). A floor wants x and z: all of y may be an edge.
    std::uint8_t axes = 1 | 4;
    /// stripes: across the bands, any length but zero.
    Vec3 direction{1.0F, 0.0F, 0.0F};
    /// gradient: runs from one point to another, constant beyond them.
    Vec3 from{};
    Vec3 to{0.0F, 1.0F, 0.0F};
};

enum class Reflection : std::uint8_t {
    constant,   ///< `reflectivity`, whatever the angle
    schlick,    ///< Schlick's approximation (1994), from `index`
    dielectric, ///< Fresnel's equations for an unpolarised ray, from `index`
};

/// Sides from which a surface can be seen. Rays pass the other side as if nothing were there; so do
/// Tracer's. A shadow ray looks from a surface to the light.
enum class Visible : std::uint8_t { both, outside, inside };

/// Glass by Sellmeier's formula: n^2 = 1 + sum of B_i w^2 / (w^2 - C_i) for a wavelength w in
/// micrometres. A scene's `wavelengths` are drawn each with the index for it.
struct Sellmeier {
    std::array<double, 3> B{}, C{}; ///< C in square micrometres
};

/// The colour seen along a ray that hits this material, with light l of colour L_l, unit vectors n
/// (normal), l (to the light) and h (halfway between l and the viewer), S what of the light the
/// shadow lets through, C the pattern's colour and R the reflected fraction:
///   C ambient + sum_l S L_l (C diffuse max(n.l, 0) + specular max(n.h, 0)^exponent)
///   + R (colour reflected) + (1 - R) transmission (colour transmitted)
/// and of all this `opacity`, with 1 - opacity of the colour straight behind the surface.
struct Material {
    Pattern pattern{};
    float ambient = 0.1F;   ///< >= 0
    float diffuse = 0.8F;   ///< >= 0
    float specular = 0.0F;  ///< >= 0, Blinn's highlight (1977), in the light's colour
    float exponent = 32.0F; ///< >= 0
    Reflection reflection = Reflection::constant;
    float reflectivity = 0.0F; ///< [0, 1]
    float transmission = 0.0F; ///< [0, 1] per surface crossed; 0 is opaque
    float index = 1.5F;        ///< index of refraction, > 0; what surrounds the scene has 1
    Sellmeier glass{}; ///< if it has any B: in place of `index`, which then is that for 587.56 nm
    /// Per unit of length inside, >= 0 (Beer and Lambert: exp(-absorption * length)).
    Vec3 absorption{};
    Visible visible = Visible::both;
    /// [0, 1]: the share of what is seen that the surface is, as paint on a pane is. Unlike what is
    /// transmitted, what is behind is neither refracted, nor absorbed, nor less for reflections.
    float opacity = 1.0F;
};

/// The number of a material in its scene: 0, 1, 2, ... in the order in which they were added.
using MaterialIndex = std::uint32_t;

} // namespace raylane
