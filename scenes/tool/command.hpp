#pragma once

#include <CLI/CLI.hpp>

#include <functional>

/// The commands of the raylane tool. Each adds itself to the command line; what is returned runs it
/// and gives the exit code: 0 done, 1 a comparison that differs. Errors come as exceptions.
namespace raylane::scenes {

struct Command {
    CLI::App* arguments;
    std::function<int()> run;
};

Command add_render_command(CLI::App& app);
Command add_info_command(CLI::App& app);
Command add_compare_command(CLI::App& app);

} // namespace raylane::scenes
