#pragma once

#include "scenes/formats/structure/drawing.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The options of drawings by name, in the words of the command line. The tool's options without
/// dashes are the names: "hydrogen-bonds". Underscores may stand for dashes.
namespace raylane::scenes {

/// Options with their values. Options of which several values are meant are there several times.
/// The value of a flag is "on" or "off".
using DrawingOptions = std::vector<std::pair<std::string, std::string>>;

/// Returns a drawing with these options. Throws BadInput, with the name of the option, for an
/// unknown one, and for a malformed value.
Drawing drawing_with(const DrawingOptions& options);

/// Parse values; `option` is the name in messages. Throw BadInput.
/// "2x2x1", from 1 to 1000 along each edge.
std::array<int, 3> repeat_of(const std::string& option, const std::string& text);
/// A number above 0 and up to 1.
float opacity_of(const std::string& option, const std::string& text);
/// A percentage from 1 to 99.
float probability_of(const std::string& option, const std::string& text);
/// "on" or "off".
bool on_or_off_of(const std::string& option, const std::string& text);
/// A direction such as "1,-1,-0.5"; nothing if it is malformed or 0.
std::optional<core::Vec3f> direction_in(const std::string& text);
/// The name of a view, or a direction to look in, such as "1,-1,-0.5". `later`: another name, of a
/// view that depends on the scene, which is returned without directions; "" for none.
core::NamedView view_named(const std::string& option, const std::string& text,
                           std::string_view later = {});

} // namespace raylane::scenes
