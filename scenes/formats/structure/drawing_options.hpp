#pragma once

#include "core/scene/best_view.hpp"
#include "scenes/formats/structure/drawing.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The one list of the options of drawings, for the tool and the library, by name and in the words
/// of the command line: "--hydrogen-bonds", with or without the dashes in front. Underscores may
/// stand for dashes.
namespace raylane::scenes {

/// Pairs of option and value. An option that has several values stands once for each of them. The
/// value of a flag is "on" or "off".
using DrawingOptions = std::vector<std::pair<std::string, std::string>>;

/// Returns a drawing with these options. Throws BadInput, with the name of the option, for an
/// unknown one, and for a malformed value.
Drawing drawing_with(const DrawingOptions& options);

/// Returns an option's name in the list: "cell-edges" for "--cell-edges" and "cell_edges".
std::string listed_name(const std::string& option);

/// Sets one option of a drawing. Throws BadInput in the same cases.
void set_option(Drawing& drawing, const std::string& name, const std::string& text);

/// The value of a flag. Throws BadInput.
bool on_or_off_of(const std::string& option, const std::string& text);
/// The names of the palettes and of the finishes, each with its value.
std::vector<std::pair<std::string_view, std::string>> named_palettes();
std::vector<std::pair<std::string_view, Finish>> named_finishes();

/// Names of views that depend on the contents: the best one, and those along the edges of a cell.
inline constexpr std::string_view later_views[] = {core::best_view_name, "a", "b", "c"};
/// The name of a view, or a direction to look in, such as "1,-1,-0.5" or "-y". later_views are
/// returned without directions.
core::NamedView view_named(const std::string& option, const std::string& text);
/// A direction that is upward in the image, such as "z" or "0,1,1".
core::Vec3f upward_direction(const std::string& option, const std::string& text);
/// A colour such as "black" or "#204060", or linear red, green and blue such as "0.1,0.2,0.3".
/// `others`: words of other values, for messages.
core::Color named_color_of(const std::string& option, const std::string& text,
                           const std::string& others = "");

} // namespace raylane::scenes
