#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

/// The commands of the raylane tool. Each add_..._command() adds one to the command line. Its
/// result runs the command and returns the exit code: 0 done, 1 a comparison that differs. Errors
/// are reported by exceptions.
namespace raylane::scenes {

/// The exit codes of the program and their meanings.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 4> exit_codes = {
    {{"0", "done"}, {"1", "difference found"}, {"2", "bad input or usage"}, {"3", "system error"}}};

/// The environment variables that the program reads.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 1> environment = {
    {{"RAYLANE_THREADS", "Threads if --threads is not given. Default: all processors."}}};

struct Command {
    CLI::App* arguments;
    std::function<int()> run;
    bool by_ranks = false; ///< the ranks of a job run it together
};

/// A value on the command line, which the command validates; nothing if it is not given.
using Argument = std::optional<std::string>;

/// Adds a command with a help text of one line, an example and, before it, details of any number of
/// lines. Defined apart, so that the commands' sources do not compile CLI11's classes, which takes
/// seconds.
CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& help,
                      const std::string& example, const std::string& details = "");
/// Sets the options that add(command) adds from `text`, which has the form of a command line.
/// Returns false if `text` is not a list of such options. Required options may be missing.
bool take_options(const std::string& text, const std::function<void(CLI::App& command)>& add);

/// Adds an option with a value. `type` is the name of the value in the help.
CLI::Option* add_option(CLI::App& command, const std::string& names, Argument& value,
                        const std::string& help, const std::string& type);
/// Adds a required argument.
void add_positional(CLI::App& command, const std::string& name, Argument& value,
                    const std::string& help);
void add_flag(CLI::App& command, const std::string& name, bool& value, const std::string& help);

Command add_render_command(CLI::App& app);
Command add_info_command(CLI::App& app);
Command add_compare_command(CLI::App& app);
Command add_convert_command(CLI::App& app);
Command add_build_command(CLI::App& app);
Command add_merge_command(CLI::App& app);
Command add_verify_command(CLI::App& app);
Command add_trace_command(CLI::App& app);
Command add_view_command(CLI::App& app);
Command add_help_command(CLI::App& app);
Command add_manual_command(CLI::App& app);
Command add_completion_command(CLI::App& app);
/// Adds the names of all commands to the help of `manual`. Call it after all commands are added.
void name_commands(CLI::App& app);
Command add_tachyon_command(CLI::App& app);

} // namespace raylane::scenes
