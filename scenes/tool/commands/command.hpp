#pragma once

#include "scenes/tool/options/option.hpp"

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace CLI {
class App;
}

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
    const OptionTable* options; ///< `run` keeps it
    bool by_ranks = false;      ///< the ranks of a job run it together
};

/// The help of a command, besides that of its options.
struct CommandText {
    std::string name;
    std::string help; ///< one line
    std::string example;
    std::string details = {}; ///< any number of lines, before the example
};

/// Adds a command with the options of a table.
CLI::App& add_command(CLI::App& app, const CommandText& text, const OptionTable& table);

/// Adds a command with the options of `Arguments`, an OptionTable. `run` gets them parsed.
template <class Arguments>
Command add_command(CLI::App& app, const CommandText& text,
                    const std::function<int(const Arguments&)>& run) {
    auto arguments = std::make_shared<Arguments>();
    return {&add_command(app, text, *arguments),
            [=] {
                arguments->parse();
                return run(*arguments);
            },
            arguments.get()};
}

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
