#include "scenes/tool/options/command_line.hpp"

#include "scenes/tool/commands/command.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>

namespace raylane::scenes {

namespace {

CLI::Option* add(CLI::App& command, AnyOption& option) {
    const std::string& names = option.names();
    if (option.properties().type.empty() && names.starts_with('-'))
        return command
            .add_flag_callback(
                names, [&option] { option.give({""}); }, option.help())
            ->disable_flag_override();
    if (!option.is_list())
        // CLI11 itself would treat an empty text as a missing value.
        return command.add_option_function<std::string>(
            names, [&option](const std::string& text) { option.give({text}); }, option.help());
    CLI::Option* const added = command.add_option_function<std::vector<std::string>>(
        names, [&option](const std::vector<std::string>& texts) { option.give(texts); },
        option.help());
    if (names.starts_with('-'))
        added->expected(1)->allow_extra_args(false)->multi_option_policy(
            CLI::MultiOptionPolicy::TakeAll);
    return added;
}

void add_all(CLI::App& command, const OptionTable& table, bool recorded_ones) {
    for (AnyOption* option : table.options()) {
        if (recorded_ones && !option->properties().is_recorded) continue;
        CLI::Option* const added = add(command, *option);
        if (added->get_items_expected_max() > 0) added->type_name(option->properties().type);
        added->group(option->group())->required(option->properties().is_required);
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
    const std::string text = printable(value, longest_value);
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

} // namespace raylane::scenes
