#include "scenes/tool/options/command_line.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/tool/commands/command.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

namespace raylane::scenes {

namespace {

/// Throws if a value is the name of another option: that of this option is missing.
void require_value(const CLI::App& command, const AnyOption& option, const std::string& text) {
    if (text.starts_with("--") && command.get_option_no_throw(text) != nullptr)
        throw CLI::ArgumentMismatch(option.name() + ": must have a value, " +
                                    option.properties().type);
}

CLI::Option* add(CLI::App& command, AnyOption& option, const std::string& names) {
    if (option.properties().type.empty() && names.starts_with('-'))
        return command
            .add_flag_callback(
                names, [&option] { option.give({""}); }, option.help())
            ->disable_flag_override();
    if (!option.is_list())
        // CLI11 itself would treat an empty text as a missing value.
        return command.add_option_function<std::string>(
            names,
            [&command, &option](const std::string& text) {
                require_value(command, option, text);
                option.give({text});
            },
            option.help());
    CLI::Option* const added = command.add_option_function<std::vector<std::string>>(
        names,
        [&command, &option](const std::vector<std::string>& texts) {
            for (const std::string& text : texts)
                require_value(command, option, text);
            option.give(texts);
        },
        option.help());
    if (names.starts_with('-'))
        added->expected(1)->allow_extra_args(false)->multi_option_policy(
            CLI::MultiOptionPolicy::TakeAll);
    return added;
}

void add_all(CLI::App& command, const OptionTable& table, bool recorded_ones) {
    for (AnyOption* option : table.options()) {
        if (recorded_ones && !option->properties().is_recorded) continue;
        CLI::Option* const added = add(command, *option, option->names());
        if (added->get_items_expected_max() > 0) added->type_name(option->properties().type);
        added->group(option->group())->required(option->properties().is_required);
        if (const char* former = option->former_name()) add(command, *option, former)->group("");
    }
}

bool is_taken(const std::string& text, const OptionTable& table) {
    CLI::App command;
    add_all(command, table, true);
    try {
        command.parse(text);
    } catch (const CLI::ParseError&) {
        return false;
    }
    return true;
}

/// The maximum length of an option's value in a text; selections may be long.
constexpr std::size_t longest_value = std::size_t{1} << 20;

/// Puts a text between quotes and escapes quotes of the same kind in it.
std::string between_quotes(const std::string& text, char quote) {
    std::string result(1, quote);
    for (const char c : text) {
        if (c == quote) result += '\\';
        result += c;
    }
    return result + quote;
}

bool is_read_as(const std::string& word, const std::string& value) {
    OptionTable table;
    const Option<std::string> option(table, "--value", scenes::word("X").recorded(), "");
    return is_taken("--value " + word, table) && option.texts().front() == value;
}

/// Returns a value in the form that take_recorded() reads back unchanged. Tabs become blanks, which
/// separate words equally.
std::string as_word(std::string value) {
    std::replace(value.begin(), value.end(), '\t', ' ');
    std::string text = printable(value, longest_value);
    constexpr std::string_view quotes = "\"'`";
    if (text.find_first_of(" \\" + std::string(quotes)) == std::string::npos) return text;
    // Quotes that the value does not contain come first, because shells read these as well.
    std::vector<std::string> ways;
    for (const bool has_any : {false, true})
        for (const char quote : quotes)
            if ((text.find(quote) != std::string::npos) == has_any)
                ways.push_back(between_quotes(text, quote));
    ways.push_back(text);
    const auto way = std::find_if(ways.begin(), ways.end(),
                                  [&](const std::string& word) { return is_read_as(word, text); });
    // A backslash at the end would escape the closing quote, so a blank separates them.
    return way != ways.end() ? *way : between_quotes(text + ' ', '"');
}

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
    const bool is_part = !option && near.empty() && command.get_parent() != nullptr;
    return "unknown argument \"" + printable(argument) + '"' +
           (is_part ? "; values with spaces need quotes" : near);
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
    // The value that the next option lacks is left over.
    if (const std::string_view text = error.what(); text.find(": must have a value") != text.npos)
        return error.what();
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

CLI::App& add_command(CLI::App& app, const CommandText& text, const OptionTable& table) {
    CLI::App* const command = app.add_subcommand(text.name, text.help);
    command->footer((text.details.empty() ? "" : text.details + "\n") + "Example: " + text.example);
    add_all(*command, table, false);
    return *command;
}

bool take_recorded(const std::string& text, OptionTable& table) {
    if (!is_taken(text, table)) return false;
    table.parse();
    return true;
}

std::string text_of_options(const std::vector<std::pair<std::string, std::string>>& options) {
    std::string text;
    for (const auto& [name, value] : options) {
        text += (text.empty() ? "" : " ") + name;
        if (!value.empty()) text += " " + as_word(value);
    }
    return text;
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App* command = chosen.empty() ? nullptr : chosen.front();
    return message_of(app, command, error) + "; see raylane " +
           (command == nullptr ? "" : command->get_name() + " ") + "--help";
}

} // namespace raylane::scenes
