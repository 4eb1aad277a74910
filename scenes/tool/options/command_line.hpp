#pragma once

#include "scenes/tool/options/option.hpp"

#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace raylane::scenes {

/// Sets the recorded options of a table from a text in the form of a command line, and parses them.
/// Returns false if `text` is not a list of such options. Throws BadInput for their values.
bool take_recorded(const std::string& text, OptionTable& table);

/// Returns such a text, in which each value reads back unchanged.
std::string text_of_options(const std::vector<std::pair<std::string, std::string>>& options);

/// Returns one line about an error in the command line, in words that do not depend on CLI11's
/// version.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

} // namespace raylane::scenes
