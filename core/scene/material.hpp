#pragma once

#include "core/numbers/vector.hpp"
#include "core/scene/fields.hpp"
#include "core/scene/formula.hpp"
#include "core/scene/glass.hpp"
#include "core/scene/texture.hpp"

#include <array>
#include <cstdint>

namespace raylane::core {

/// Linear RGB. 1 is the film's white.
using Color = Vec3f;

/// Colour as a function of the point in space, or an image on the surface.
struct Pattern {
    PatternKind kind = PatternKind::solid;
    /// solid: the first. checker, stripes: alternating, the first in the cell that begins at the
    /// origin. gradient: at `from` and at `to`. Others: not used.
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
    /// formula: the colour of a point.
    Formula formula{};
    /// Coordinates of all but solids and images.
    PatternSpace space = PatternSpace::world;
    /// image: one copy of it extends over `width` and `height` of the coordinates u and v on the
    /// shape in object space, > 0.
    Texture image{};
    float width = 1.0F, height = 1.0F;
    ImageWrap wrap = ImageWrap::repeat;
    /// image: from pole to pole of spheres and ellipsoids, any length but zero.
    Vec3f axis{0.0F, 1.0F, 0.0F};

    /// Returns true if the pattern follows transforms of its objects.
    bool follows_objects() const {
        return kind == PatternKind::image ||
               (kind != PatternKind::solid && kind != PatternKind::cutaway &&
                space == PatternSpace::object);
    }
    /// Returns true if color_on() finds the colour.
    bool is_on_surface() const {
        return kind == PatternKind::image || kind == PatternKind::cutaway;
    }
    /// Returns true if the colour depends on more than the point in space.
    bool needs_shape() const {
        return is_on_surface() || follows_objects() ||
               (kind == PatternKind::formula && formula.program().needs_shape);
    }
};

using Material = MaterialOf<Vec3f, Pattern, Sellmeier>;

} // namespace raylane::core
