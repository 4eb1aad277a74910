#pragma once

#include "core/scene/fit_camera.hpp"
#include "core/scene/scene.hpp"
#include "scenes/files/input_file.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace raylane::scenes {

enum class Style {
    automatic, ///< spheres for more than 500 atoms or atoms with radii, otherwise balls
    balls,     ///< balls and sticks
    sticks,    ///< thin sticks, two or three for double or triple bonds
    licorice,  ///< thick sticks, one for each bond
    spheres,   ///< with van der Waals' radii, or those of the file
    points,    ///< small balls of one size
};

/// Properties of a structure as a whole. Several frames should share those of one frame.
struct DrawingScale {
    Style style = Style::automatic;
    float usual_radius = 1.5F;      ///< of atoms of unknown elements
    double least = 0.0, most = 0.0; ///< range of the property that colours stand for
};

/// Options for rendering a structure.
struct Drawing {
    Style style = Style::automatic;
    std::string color = "element";         ///< or "chain", "residue", or the name of a property
    std::string select = "all";            ///< in the language of select_atoms
    std::array<int, 3> repeat = {1, 1, 1}; ///< cells side by side along the edges
    bool show_cell = false;                ///< the cell's edges
    bool ellipsoids = false; ///< ellipsoids and spheres that hold half of a displacement
    core::FitCamera fit_camera{};
    int width = 1200, height = 900; ///< pixels of the image
    float opacity = 1.0F;           ///< of atoms and bonds, in (0, 1]
    float depth_cue = 0.3F;         ///< share of the background in the farthest atoms, in [0, 1)
    std::optional<DrawingScale> scale{}; ///< of another frame
};

/// The atoms of a shape: an atom, twice; the ends of a bond; or `no_atoms` for the cell's edges.
using AtomPair = std::array<AtomIndex, 2>;
inline constexpr AtomPair no_atoms = {std::numeric_limits<AtomIndex>::max(),
                                      std::numeric_limits<AtomIndex>::max()};

/// Fills a builder with the atoms, a camera that sees all of them, lights around them, and settings
/// for a good image. `file` is the name in messages. `atoms_of_shape`, unless null, receives the
/// atoms of each shape. Throws BadInput for missing data: an empty selection, an unknown property.
/// Reports omitted bonds, and names that select nothing, to `on_remark`.
DrawingScale draw(const Structure& structure, const Drawing& drawing, const std::string& file,
                  core::SceneBuilder& builder, std::vector<AtomPair>* atoms_of_shape,
                  const OnRemark& on_remark);

} // namespace raylane::scenes
