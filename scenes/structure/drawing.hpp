#pragma once

#include "core/scene/framing.hpp"
#include "core/scene/scene.hpp"
#include "scenes/input_file.hpp"
#include "scenes/structure/structure.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace raylane::scenes {

enum class Style {
    automatic, ///< spheres of more than 500 atoms, else balls
    balls,     ///< and sticks
    sticks,    ///< thin ones, of double and triple bonds two and three
    licorice,  ///< thick ones, one for each bond
    spheres,   ///< van der Waals' radii, or those of the file
    points,    ///< small balls of one size
};

/// What follows from a structure as a whole, and so for several frames should from one of them.
struct DrawingScale {
    Style style = Style::automatic;
    float usual_radius = 1.5F;      ///< of atoms of no known element
    double least = 0.0, most = 0.0; ///< of what colours stand for, if that is a number
};

/// How a structure is drawn.
struct Drawing {
    Style style = Style::automatic;
    std::string color = "element";         ///< or "chain", "residue", or the name of a property
    std::string select = "all";            ///< as select_atoms has it
    std::array<int, 3> repeat = {1, 1, 1}; ///< cells side by side along the edges
    bool show_cell = false;                ///< its edges
    bool ellipsoids = false;               ///< and spheres, which hold half of a displacement
    core::Framing framing;
    int width = 1200, height = 900; ///< pixels of the picture
    float opacity = 1.0F;           ///< of all that is drawn, in (0, 1]
    float depth_cue = 0.3F; ///< how much of the background the farthest atoms have, in [0, 1)
    std::optional<DrawingScale> scale; ///< of another frame
};

/// Whose shape one is: of an atom, twice that; of a bond, its ends; `no_atoms` of the cell's edges.
using AtomPair = std::array<AtomIndex, 2>;
inline constexpr AtomPair no_atoms = {std::numeric_limits<AtomIndex>::max(),
                                      std::numeric_limits<AtomIndex>::max()};

/// Fills a builder with the atoms, a camera that sees them all, lights around them, and settings
/// for a picture that one looks at. `file` is what messages call it; `atoms_of_shape`, if there is
/// one, is left with the atoms of each shape. Throws BadInput for what there is not: nothing
/// selected, no such property. Tells `on_remark` of bonds that are left out, and of names that
/// select nothing.
DrawingScale draw(const Structure& structure, const Drawing& drawing, const std::string& file,
                  core::SceneBuilder& builder, std::vector<AtomPair>* atoms_of_shape = nullptr,
                  const OnRemark& on_remark = {});

} // namespace raylane::scenes
