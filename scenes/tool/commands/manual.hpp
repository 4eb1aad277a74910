#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

/// Documents that are generated from the same table of commands and options as the help.
namespace raylane::scenes {

/// Returns a command's page for man(1), in the macros of man(7). For `app` itself, returns the page
/// of the whole tool.
std::string manual_page(const CLI::App& app, const CLI::App& command);

/// Returns the script by which bash completes commands, options, their choices and file names. zsh
/// reads it after `autoload bashcompinit && bashcompinit`.
std::string completion_script(const CLI::App& app);

/// Returns the choices in an option's type name: "vector" and "reference" for "vector|reference",
/// none for "N".
std::vector<std::string> choices_of(const CLI::Option& option);

/// Returns all commands. This function and the next two keep the order of the help.
std::vector<const CLI::App*> commands_of(const CLI::App& app);
/// Returns the options with dashes.
std::vector<const CLI::Option*> options_of(const CLI::App& command);
std::vector<const CLI::Option*> positionals_of(const CLI::App& command);
/// Returns true for an option without a value.
bool is_flag(const CLI::Option& option);

} // namespace raylane::scenes
