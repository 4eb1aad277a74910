#include "scenes/tool/commands/usage.hpp"

#include "scenes/errors.hpp"

#include <algorithm>
#include <vector>

namespace raylane::scenes {

namespace {

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({}))
        names.push_back(command->get_name());
    return names;
}

/// Returns the long names of the options, without dashes.
std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back(name);
    return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns "size" for "--size=3x3", or an empty text if the argument is not a long option.
std::string option_name(const std::string& argument) {
    return argument.starts_with("--") ? argument.substr(2, argument.find('=') - 2) : "";
}

std::string unknown(const std::string& argument, const CLI::App& command) {
    const bool option = argument.starts_with("-");
    const std::vector<std::string> known = option ? option_names(command) : command_names(command);
    const std::string near = suggestion(option ? option_name(argument) : argument,
                                        {known.begin(), known.end()}, option ? "--" : "");
    return "unknown argument \"" + printable(argument) + '"' + near;
}

/// Returns the option that CLI11 names at the start of its message: "--size: ...", "json was ...".
const CLI::Option* option_in(const CLI::App& command, const std::string& message) {
    const std::string name = message.substr(0, message.find_first_of(": "));
    for (const CLI::Option* option : command.get_options())
        if (name == option->get_name() || contains(option->get_lnames(), name)) return option;
    return nullptr;
}

std::string wrong_count(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) return option.get_name() + ": must have no value";
    if (option.count() > 1) return option.get_name() + ": must be given only once";
    return option.get_name() + ": must have a value, " + option.get_type_name();
}

std::string message_of(const CLI::App& app, const CLI::App* command, const CLI::ParseError& error) {
    if (const std::vector<std::string> extras = app.remaining(); !extras.empty()) {
        const std::string name = option_name(extras.front());
        if (command != nullptr && contains(option_names(*command), name))
            return "--" + name + ": must come after \"" + command->get_name() + '"';
        return unknown(extras.front(), app);
    }
    if (command == nullptr) return "must be given a command: " + alternatives(command_names(app));
    if (const std::vector<std::string> extras = command->remaining(); !extras.empty())
        return unknown(extras.front(), *command);
    const std::string text = error.what();
    if (error.get_name() == "RequiredError") {
        for (const CLI::Option* option : command->get_options())
            if (option->get_required() && option->count() == 0)
                return option->get_name() + ": must be given";
    } else if (const CLI::Option* option = option_in(*command, text)) {
        return wrong_count(*option);
    }
    return printable(text, 200);
}

} // namespace

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App* command = chosen.empty() ? nullptr : chosen.front();
    return message_of(app, command, error) + "; see raylane " +
           (command == nullptr ? "" : command->get_name() + " ") + "--help";
}

} // namespace raylane::scenes
