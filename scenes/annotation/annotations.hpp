#pragma once

#include "core/scene/surroundings.hpp"
#include "scenes/annotation/sheet.hpp"
#include "scenes/formats/structure/structure_file.hpp"

#include <optional>
#include <string>
#include <vector>

/// Annotations of an image of atoms: legend, scale bar, axes, labels and distances.
namespace raylane::scenes {

enum class Axes { of_space, of_cell };

/// The texts of a label: "SELECTION: TEXT". With {element}, {name}, {resn}, {resi}, {chain} or
/// {index} in the text, each atom has a label; otherwise the middle of the atoms has one.
struct LabelWords {
    std::string select, text;
};
/// Throws BadInput.
LabelWords label_words_of(const std::string& option, const std::string& text);

/// A distance between the middles of two selections: "SELECTION: SELECTION".
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
    double font_size = 0.0; ///< in pixels; 0: 1/32 of the image's height
    double dpi = 0.0;       ///< pixels per inch; 0: unknown

    bool any() const {
        return legend || scale_bar || axes || !labels.empty() || !distances.empty();
    }
};

/// The image that annotations lie over.
struct AnnotatedView {
    core::Camera camera;
    int width, height;
    core::Color background;
};

/// Returns the annotations as vector graphics. Throws BadInput, with the option, for selections
/// without atoms, for --triad without a cell, and for a legend without colours. `on_remark`
/// receives names that select nothing, and that the scale bar holds at one depth only.
Sheet sheet_of(const Annotations& annotations, const Legend& legend, const AnnotatedView& view,
               const OnRemark& on_remark);

/// Returns round numbers within a range, ascending: three to eight of them if `least` < `most`.
std::vector<double> round_numbers_in(double least, double most);

} // namespace raylane::scenes
