#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace raylane::scenes {

/// Returns one line about an error in the command line, in words that do not depend on CLI11's
/// version.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

} // namespace raylane::scenes
