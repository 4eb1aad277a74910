#pragma once

#include "core/scene/scene.hpp"
#include "scenes/annotation/sheet.hpp"
#include "scenes/formats/structure/structure_file.hpp"

#include <optional>
#include <string>
#include <vector>

/// Annotations of an image of atoms: legend, scale bar, axes, labels and distances.
namespace raylane::scenes {

enum class Axes { of_space, of_cell };

/// The texts of a label: "SELECTION: TEXT".
/// - With {element}, {name} or {index} in the text, each atom has a label, and so has each copy of
///   it in other cells, on faces and corners.
/// - Otherwise with {resn} or {resi}, each residue has one: at its C-alpha, if that is selected, or
///   at the middle of its selected atoms. With {chain} alone, each chain has one.
/// - Without a field, the middle of the atoms has one; of a single atom, the first copy that is
///   not hidden.
///
/// Labels with fields are left out if opaque shapes of other atoms hide their places. Labels
/// outside of the image are left out, too.
struct LabelWords {
    std::string select, text;
};
/// Throws BadInput.
LabelWords label_words_of(const std::string& option, const std::string& text);

/// A distance between the middles of two selections: "SELECTION: SELECTION". The first copies of
/// atoms count; if the second selection is a single atom, the copy nearest to the first place.
struct DistanceWords {
    std::string from, to;
};
/// Throws BadInput.
DistanceWords distance_words_of(const std::string& option, const std::string& text);

struct Annotations {
    bool legend = false;
    std::string legend_title{};        ///< of a bar of colours; empty: the property's name
    std::optional<double> scale_bar{}; ///< in angstrom; 0: a round length
    std::optional<Axes> axes{};
    std::vector<LabelWords> labels{};
    std::vector<DistanceWords> distances{};
    std::string font = "sans-serif";
    double font_size = 0.0;     ///< in pixels; 0: 1/32 of the image's height
    double dpi = 0.0;           ///< pixels per inch; 0: unknown
    bool axes_on_right = false; ///< as arrows of the cell are on the left

    bool any() const {
        return legend || scale_bar || axes || !labels.empty() || !distances.empty();
    }
};

/// The image that annotations lie over.
struct AnnotatedView {
    core::Camera camera;
    int width, height;
    core::Color background;
    const core::Scene* scene = nullptr; ///< whose shapes hide labels; null: none are hidden
};

/// Returns the annotations as vector graphics. A scene that is not from atoms has a legend without
/// a structure, and lengths without a unit.
///
/// Throws BadInput, with the option, for selections without atoms, --triad without a cell, a legend
/// without colours, and a scale bar that is not in the image.
///
/// `on_remark` receives:
/// - names that select nothing;
/// - labels and distances that are left out;
/// - a title without a bar of colours;
/// - texts that are too small or too large;
/// - that the scale bar of a perspective holds at one depth only.
Sheet sheet_of(const Annotations& annotations, const Legend& legend, const AnnotatedView& view,
               const OnRemark& on_remark);

/// Returns round numbers within a range, ascending: three to eight of them if `least` < `most`.
std::vector<double> round_numbers_in(double least, double most);

} // namespace raylane::scenes
