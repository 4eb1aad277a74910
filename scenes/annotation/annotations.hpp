#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The words of annotations of an image of atoms: legend, scale bar, axes, labels and distances.
namespace raylane::scenes {

enum class Axes {
    of_space,
    of_cell,
    automatic, ///< of the cell, if there is one
};
/// "xyz", "abc" and "auto".
std::vector<std::pair<std::string_view, Axes>> named_axes();

/// The texts of a label: "SELECTION: TEXT".
/// - With {element}, {name} or {index} in the text, each atom has a label, and so has each copy of
///   it in other cells, on faces and corners.
/// - Otherwise with {resn} or {resi}, each residue has one: at its C-alpha, if that is selected, or
///   at the middle of its selected atoms. With {chain} alone, each chain has one.
/// - Without a field, the middle of the atoms has one; of a single atom, the first copy that is
///   not hidden.
///
/// Atoms that the image does not show do not count. Labels with fields are left out if opaque
/// shapes of other atoms hide their places. Labels outside of the image are left out, too.
struct LabelWords {
    std::string select, text;
    std::string option = "--label"; ///< in messages
};
/// Throws BadInput.
LabelWords label_words_of(const std::string& option, const std::string& text);

/// A distance between the middles of two selections: "SELECTION: SELECTION". The first copies of
/// atoms count; if the second selection is a single atom, the copy nearest to the first place. It
/// is left out if the image shows no atom of a selection.
struct DistanceWords {
    std::string from, to;
    std::string option = "--distance"; ///< in messages
};
/// Throws BadInput.
DistanceWords distance_words_of(const std::string& option, const std::string& text);

/// Parses a length in angstrom; 0 for "auto". Throws BadInput.
double bar_length_of(const std::string& option, const std::string& text);

struct Annotations {
    bool legend = false;
    bool is_legend_implied = false;    ///< there is a title alone; for messages
    std::string legend_title{};        ///< empty: the name of a number
    std::optional<double> scale_bar{}; ///< in angstrom; 0: a round length
    std::optional<Axes> axes{};
    std::vector<LabelWords> labels{};
    std::vector<DistanceWords> distances{};
    std::string font = "sans-serif";
    /// In pixels; 0: that of usual_font_size().
    double font_size = 0.0;
    double dpi = 0.0;           ///< pixels per inch; 0: unknown
    bool axes_on_right = false; ///< as arrows of the cell are on the left
    /// The places of legend, scale bar and axes depend on the size of the image alone, so that they
    /// stay in a sequence of images.
    bool is_steady = false;
    /// Messages name options as on the command line ("--scale-bar"), not as in the library
    /// ("scale_bar").
    bool has_dashes = true;

    bool any() const {
        return legend || scale_bar || axes || !labels.empty() || !distances.empty();
    }
    /// Returns the name of an option in messages, such as of "scale-bar".
    std::string option(std::string_view name) const;
};

/// Returns a size in points as pixels. `dpi`: pixels per inch; 0: unknown, then 300.
double pixels_of_points(double size, double dpi);

/// Returns the size of texts in an image of this height, in pixels: 1/32 of the height, but at
/// least 10 pixels and at most a fifth of the height.
double usual_font_size(int height);

/// Sets an option of annotations by its name on the command line, such as "--scale-bar" or
/// "scale_bar". "on" is a value of flags, and stands for "auto"; "off" has no effect. "labels" and
/// "distances" are "label" and "distance", but messages number them from 0. Returns false if there
/// is no such option. Throws BadInput for malformed values.
bool set_option(Annotations& annotations, const std::string& name, const std::string& text);

} // namespace raylane::scenes
