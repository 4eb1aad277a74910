#pragma once

#include "core/numbers/vector.hpp"
#include "core/scene/appearance.hpp"
#include "core/scene/formula.hpp"
#include "core/scene/glass.hpp"

#include <array>
#include <cstdint>

namespace raylane::core {

/// Linear RGB. 1 is the film's white.
using Color = Vec3f;

/// Colour as a function of the point in space, in world coordinates.
struct Pattern {
    PatternKind kind = PatternKind::solid;
    /// solid: the first. checker, stripes: alternating, the first in the cell that begins at the
    /// origin. gradient: at `from` and at `to`. formula: not used.
    std::array<Color, 2> colors = {Color(1.0F), Color(1.0F)};
    /// checker: the cells' edge; stripes: their width. > 0
    float size = 1.0F;
    /// checker: the axes that count, as bits (x 1, y 2, z 4), and the axes along which cells
    /// contain their upper edge, not the lower one (x 8, y 16, z 32). A floor needs x and z, as all
    /// of its points may be on an edge of y.
    std::uint8_t axes = 1 | 4;
    /// stripes: across the bands, any length but zero.
    Vec3f direction{1.0F, 0.0F, 0.0F};
    /// gradient: runs from one point to the other, constant beyond them.
    Vec3f from{0.0F};
    Vec3f to{0.0F, 1.0F, 0.0F};
    /// formula: the colour of a point in world coordinates.
    Formula formula{};
};

/// Sides from which a surface is visible. Rays pass the other side as if nothing were there. A
/// shadow ray looks from a surface to the light.
enum class Visible : std::uint8_t { both, outside, inside };

/// The colour seen along a ray that hits this material. Symbols: light l of colour L_l; unit
/// vectors n (normal), l (to the light) and h (halfway between l and the viewer; for Phong's
/// highlight n.h stands for the cosine between l and the reflected ray); S the share of
/// the light that the shadow lets through; C the pattern's colour; R the reflected fraction. The
/// colour is
///   C ambient + sum_l S L_l (C diffuse max(n.l, 0) + specular max(n.h, 0)^exponent)
///   + R (colour reflected) + (1 - R) transmission (colour transmitted)
/// This counts with weight `opacity`, and the colour straight behind the surface with 1 - opacity.
struct Material {
    Pattern pattern;
    float ambient = 0.1F;   ///< >= 0
    float diffuse = 0.8F;   ///< >= 0
    float specular = 0.0F;  ///< >= 0, of the highlight, in the light's colour
    float exponent = 32.0F; ///< >= 0
    Highlight highlight = Highlight::blinn;
    Reflection reflection = Reflection::constant;
    float reflectivity = 0.0F; ///< [0, 1]
    float transmission = 0.0F; ///< [0, 1] per surface crossed; 0 is opaque
    float index = 1.5F;        ///< index of refraction, > 0; empty space has 1
    Sellmeier glass{}; ///< if set, `index` is its n_d, or its index at each wavelength of a scene
    Vec3f absorption{
        0.0F}; ///< per unit of length inside, >= 0 (Beer-Lambert: exp(-absorption * length))
    /// [0, 1]: the share of the colour that comes from the surface, as with paint on a pane. The
    /// rest comes from straight behind it. Unlike transmitted light, the rest is not refracted,
    /// absorbed, or reduced by reflections.
    float opacity = 1.0F;
    Visible visible = Visible::both;

    bool transmits() const { return transmission > 0.0F; }
    bool is_transparent() const { return opacity < 1.0F; }
    /// Returns true if light may pass it in any way.
    bool lets_light_pass() const { return transmits() || is_transparent(); }
    bool reflects() const { return reflection != Reflection::constant || reflectivity > 0.0F; }
    /// Returns true if a ray that enters (or leaves) here sees the surface.
    bool is_seen(bool entering) const {
        return visible == Visible::both || (visible == Visible::outside) == entering;
    }
};

} // namespace raylane::core
