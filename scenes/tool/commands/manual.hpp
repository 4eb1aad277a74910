#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

/// The documents that the program prints. Manual pages and the completion are generated from the
/// same table of commands and options as the help.
namespace raylane::scenes {

/// Returns a command's page for man(1), in the macros of man(7). For `app` itself, returns the page
/// of the whole tool.
std::string manual_page(const CLI::App& app, const CLI::App& command);

/// Returns the script by which bash completes commands, options, their choices and file names. zsh
/// reads it after `autoload bashcompinit && bashcompinit`.
std::string completion_script(const CLI::App& app);

/// Returns all commands in the order of the help.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// A page of the documentation, in Markdown.
struct Page {
    std::string_view topic, text;
};

/// Returns the pages that an installed copy has: the README first.
std::span<const Page> documentation_pages();

} // namespace raylane::scenes
