#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

/// The commands of the raylane tool. Each adds itself to the command line; what is returned runs it
/// and gives the exit code: 0 done, 1 a comparison that differs. Errors come as exceptions.
namespace raylane::scenes {

/// What the program ends with, and when.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 4> exit_codes = {
    {{"0", "done"},
     {"1", "a comparison that differs, or a picture that is not what it says"},
     {"2", "bad input or usage"},
     {"3", "the system refused"}}};

/// Variables of the environment that it asks for.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 1> environment = {
    {{"RAYLANE_THREADS", "Threads where --threads does not say (default: all processors)"}}};

struct Command {
    CLI::App* arguments;
    std::function<int()> run;
    bool by_ranks = false; ///< those of a job do it together
};

/// Value on the command line, for the command to judge; nothing if it is not there.
using Argument = std::optional<std::string>;

/// Adds a command, whose help says what it does and shows an example. CLI11's classes are compiled
/// in what calls this alone, which takes seconds.
CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& help,
                      const std::string& example);
/// Has values of the options that add(command) adds, from what a command line would have. False
/// without a list of them; what must be given may be missing.
bool take_options(const std::string& text, const std::function<void(CLI::App& command)>& add);

/// Adds an option that has a value; `type` is what the help calls that.
CLI::Option* add_option(CLI::App& command, const std::string& names, Argument& value,
                        const std::string& help, const std::string& type);
/// Adds an argument that must be given.
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
Command add_manual_command(CLI::App& app);
Command add_completion_command(CLI::App& app);
/// To be called once all are there: the manual's choices are the commands.
void name_commands(CLI::App& app);
Command add_tachyon_command(CLI::App& app);

} // namespace raylane::scenes
