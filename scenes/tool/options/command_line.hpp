#pragma once

#include "scenes/tool/options/option.hpp"

#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

/// Sets the recorded options of a table from a text in the form of a command line, and parses them.
/// Returns false if `text` is not a list of such options. Throws BadInput for their values.
bool take_recorded(const std::string& text, OptionTable& table);

/// Returns such a text, in which each value reads back unchanged.
std::string text_of_options(const std::vector<std::pair<std::string, std::string>>& options);

} // namespace raylane::scenes
