#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

/// What is made of the same table of commands and options as the help.
namespace raylane::scenes {

enum class Shell { bash, zsh, fish };

/// A command's page for man(1), in the macros of man(7); that of the whole tool for `app` itself.
std::string manual_page(const CLI::App& app, const CLI::App& command);

/// What a shell reads to complete commands, options, their choices and names of files.
std::string completion_script(const CLI::App& app, Shell shell);

/// "vector" and "reference" of what the help calls "vector|reference"; none of what it calls "N".
std::vector<std::string> choices_of(const CLI::Option& option);

/// Commands, and options of one, in the order of the help.
std::vector<const CLI::App*> commands_of(const CLI::App& app);
/// Those with dashes.
std::vector<const CLI::Option*> options_of(const CLI::App& command);
std::vector<const CLI::Option*> positionals_of(const CLI::App& command);
/// True of what stands for itself, without a value.
bool is_flag(const CLI::Option& option);

} // namespace raylane::scenes
