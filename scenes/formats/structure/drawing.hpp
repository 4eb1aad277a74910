#pragma once

#include "core/scene/fit_camera.hpp"
#include "core/scene/scene.hpp"
#include "scenes/files/input_file.hpp"
#include "scenes/formats/structure/atom_colors.hpp"
#include "scenes/formats/structure/cut.hpp"
#include "scenes/formats/structure/representation.hpp"
#include "scenes/formats/structure/structure.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace raylane::scenes {

/// The meaning of the colours of a drawing's atoms.
struct ColorKey {
    std::string property{}; ///< that colours stand for; empty: there are entries
    ColorRange range{};
    std::string palette{}; ///< one of palette_names(); empty: the first
    std::vector<std::pair<std::string, std::uint32_t>> entries{}; ///< names and sRGB colours
};

/// The maximum number of names of a key.
inline constexpr std::size_t max_key_entries = 64;

/// The place of a copy of an atom.
struct AtomPlace {
    AtomIndex atom;
    core::Vec3f at;
};

/// Properties of a structure as a whole. Several frames should share those of one frame.
struct DrawingScale {
    float usual_radius = 1.5F;                ///< of atoms of unknown elements
    std::vector<Style> styles = {};           ///< of the looks that leave it open
    std::map<std::string, ColorRange> ranges; ///< of the properties that colours stand for
    std::optional<core::NamedView> view = {}; ///< of the frame, if the drawing names one
    std::vector<ColorKey> keys = {};          ///< of this frame's colours, each once
    bool has_too_many_colors = false;         ///< for a key of names
    /// The copies of this frame's atoms of which planes leave a part, by ascending atom, in the
    /// first cell first; empty: the atoms are where the file has them. Kept if the atoms of shapes
    /// are.
    std::vector<AtomPlace> places = {};
    /// 1 for atoms that a cartoon, tube or trace shows. Only some of them have shapes. Empty: none.
    std::vector<char> is_in_chain = {};

    /// Widens the ranges to those of another frame.
    void include(const DrawingScale& other);
};

/// A representation, in the words of representation_of().
struct ShowWords {
    std::string text;
    std::string option = "--show"; ///< in messages
};

/// Ellipsoids of displacements in place of balls.
enum class Ellipsoids : std::uint8_t {
    none,
    plain,
    ellipses, ///< with the three principal ellipses
    octants,  ///< and without the octant that faces the camera
};
constexpr const char* option_of(Ellipsoids ellipsoids) {
    constexpr const char* options[] = {"", "--ellipsoids", "--ellipses", "--octants"};
    return options[static_cast<std::size_t>(ellipsoids)];
}

/// Options for rendering a structure.
struct Drawing {
    Style style = Style::automatic;
    /// In the words of color_words_of(). Empty: "element" for atoms, and usual_chain_color() for
    /// chains.
    std::string color{};
    std::string select = "all";            ///< in the language of select_atoms
    std::array<int, 3> repeat = {1, 1, 1}; ///< cells side by side along the edges
    bool show_cell = false;                ///< the cell's edges
    bool show_axes = false;                ///< arrows along its edges, beside the atoms
    /// See CrystalLook. Unset: as in CrystalLook for crystals, otherwise atoms as in the file.
    std::optional<bool> boundary{}, whole{};
    std::vector<std::string> polyhedra{}; ///< in the words of polyhedra_of()
    Ellipsoids ellipsoids = Ellipsoids::none;
    bool hydrogen_bonds = false; ///< dashed lines, see find_hydrogen_bonds()
    float probability = 0.5F;    ///< share of a displacement within its ellipsoid
    core::FitCamera fit_camera{};
    /// From where the camera will look; unset: as in `fit_camera`, and obliquely at crystals. A
    /// view without a direction has the name of one that depends on the atoms: see later_views.
    std::optional<core::NamedView> view{};
    std::optional<core::Vec3f> up{}; ///< in the image, in place of the view's; any length but zero
    bool perspective = false;        ///< of crystals, too
    int width = 1200, height = 900;  ///< pixels of the image
    float opacity = 1.0F;            ///< of atoms and bonds, in (0, 1]
    /// Share of the background in the colour of the farthest atoms, in [0, 1). Unset: 0.3, and 0 if
    /// colours stand for a property or surfaces are flat.
    std::optional<float> depth_cue{};
    std::optional<DrawingScale> scale{}; ///< of another frame
    /// If there are any, only the atoms that they select are shown. Each replaces the ones before
    /// it for the atoms that it selects. Their unset words follow from the options above.
    std::vector<ShowWords> show{};
    std::vector<std::string> hide{};     ///< selections of atoms that are not shown
    std::string radius{}, scale_radii{}; ///< in the words of size_words_of(); empty: unset
    std::string palette{};               ///< one of palette_names(); empty: the first
    std::optional<ColorRange> range{};   ///< of a property that colours stand for
    Finish finish = Finish::usual;
    core::Color background{1.0F};
    std::vector<CutPlane> cuts{}; ///< only the parts of atoms on their sides are shown
    /// The same for two planes across the view: depths in angstrom, from the middle of the atoms
    /// towards the viewer.
    std::optional<std::pair<double, double>> slab{};
};

/// Throws BadInput, for --up, if a camera that looks along `direction` cannot have `up` upward.
void require_upward(const core::Vec3f& up, const core::Vec3f& direction);

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
