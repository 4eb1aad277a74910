#include "scenes/files/atomic_file.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/commands/manual.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

const CLI::App& command_named(const CLI::App& app, const std::string& name) {
    std::vector<std::pair<std::string_view, const CLI::App*>> choices;
    const std::vector<const CLI::App*> commands = commands_of(app);
    choices.reserve(commands.size());
    for (const CLI::App* command : commands) // the names outlive `choices`
        choices.emplace_back(command->get_name(), command);
    return *choice_named<const CLI::App*>("COMMAND", name, choices);
}

struct HelpArguments : OptionTable {
    Option<std::string> topic = {*this, "TOPIC", word("").otherwise("list the pages"),
                                 "Page or command."};
};

struct ManualArguments : OptionTable {
    Option<std::string> command = {*this, "COMMAND", word("").otherwise("the whole tool"),
                                   "Command."};
    Option<std::string> folder = {*this, "--all", file_name("FOLDER").without({"COMMAND"}),
                                  "Write the pages of all commands into a folder, named "
                                  "raylane.1, raylane-render.1, ..."};
};

struct CompletionArguments : OptionTable {
    Option<bool> shell = {*this, "SHELL", choice<bool>({{"bash", true}}).required(),
                          "Shell: bash."};
};

void write_pages(const CLI::App& app, const std::filesystem::path& folder) {
    std::vector<const CLI::App*> commands = commands_of(app);
    commands.push_back(&app);
    for (const CLI::App* command : commands) {
        const std::string name =
            command == &app ? "raylane.1" : "raylane-" + command->get_name() + ".1";
        AtomicFile file(folder / name);
        file.write(manual_page(app, *command));
        file.commit();
    }
}

int print_manual(const CLI::App& app, const ManualArguments& arguments) {
    if (arguments.folder) {
        write_pages(app, *arguments.folder);
        return 0;
    }
    const CLI::App& command = arguments.command ? command_named(app, *arguments.command) : app;
    std::fputs(manual_page(app, command).c_str(), stdout);
    return 0;
}

/// Returns the title of a page, its first line.
std::string_view title_of(const Page& page) {
    return page.text.substr(2, page.text.find('\n') - 2);
}

void list_topics() {
    std::fputs("raylane help TOPIC prints a page:\n", stdout);
    for (const Page& page : documentation_pages())
        std::printf("  %-13.*s %.*s\n", static_cast<int>(page.topic.size()), page.topic.data(),
                    static_cast<int>(title_of(page).size()), title_of(page).data());
    std::fputs("raylane COMMAND --help lists the options of a command.\n", stdout);
}

int print_help(const CLI::App& app, const HelpArguments& arguments) {
    if (!arguments.topic) {
        list_topics();
        return 0;
    }
    std::vector<std::pair<std::string_view, std::string>> choices;
    for (const Page& page : documentation_pages())
        choices.emplace_back(page.topic, page.text);
    const std::vector<const CLI::App*> commands = commands_of(app);
    for (const CLI::App* command : commands) // whose names outlive this
        choices.emplace_back(command->get_name(), command->help("raylane"));
    std::fputs(choice_named<std::string>("TOPIC", *arguments.topic, choices).c_str(), stdout);
    return 0;
}

} // namespace

Command add_help_command(CLI::App& app) {
    return add_command<HelpArguments>(
        app,
        {.name = "help",
         .help = "Print a page of the documentation",
         .example = "raylane help scenes"},
        [&app](const HelpArguments& arguments) { return print_help(app, arguments); });
}

Command add_manual_command(CLI::App& app) {
    return add_command<ManualArguments>(
        app,
        {.name = "manual",
         .help = "Print a manual page, in the format of man",
         .example = "raylane manual render | man -l -"},
        [&app](const ManualArguments& arguments) { return print_manual(app, arguments); });
}

void name_commands(CLI::App& app) {
    std::string text;
    for (const CLI::App* command : commands_of(app))
        text.append(text.empty() ? "" : "|").append(command->get_name());
    app.get_subcommand("manual")->get_option("COMMAND")->type_name(text);
    for (const Page& page : documentation_pages())
        text.append("|").append(page.topic);
    app.get_subcommand("help")->get_option("TOPIC")->type_name(text);
}

Command add_completion_command(CLI::App& app) {
    return add_command<CompletionArguments>(app,
                                            {.name = "completion",
                                             .help = "Print a completion script for bash",
                                             .example = "source <(raylane completion bash)"},
                                            [&app](const CompletionArguments&) {
                                                std::fputs(completion_script(app).c_str(), stdout);
                                                return 0;
                                            });
}

} // namespace raylane::scenes
