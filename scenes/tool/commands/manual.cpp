#include "scenes/tool/commands/manual.hpp"

#include "scenes/library/raylane/version.h"
#include "scenes/tool/commands/command.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

/// Returns a text that roff prints literally: no escapes, and no requests at the start of lines.
std::string plain(std::string_view text, bool is_typed = false) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-' && is_typed)
            result += "\\-"; // a minus sign; a plain '-' is a hyphen in roff
        else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
            result.append("\\&").push_back(c);
        else
            result += c;
    }
    return result;
}

std::string bold(std::string_view text) {
    return "\\fB" + plain(text, true) + "\\fR";
}
std::string italic(std::string_view text) {
    return "\\fI" + plain(text, true) + "\\fR";
}

std::string in_capitals(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
    return text;
}

/// Returns "draws scenes" for "raylane draws scenes.", and "draw" for "Draw".
std::string without_subject(std::string text) {
    constexpr std::string_view subject = "raylane ";
    if (text.starts_with(subject)) text.erase(0, subject.size());
    if (text.ends_with('.')) text.pop_back();
    const std::string_view capitals = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    if (capitals.find(text[0]) != std::string_view::npos) text[0] = static_cast<char>(text[0] + 32);
    return text;
}

void add_option_to(std::string& page, const CLI::Option& option) {
    std::string names;
    const auto add = [&](const std::string& name) {
        names.append(names.empty() ? "" : ", ").append(bold(name));
    };
    for (const std::string& name : option.get_snames())
        add("-" + name);
    for (const std::string& name : option.get_lnames())
        add("--" + name);
    if (!is_flag(option)) names += " " + italic(option.get_type_name());
    page += ".TP\n" + names + "\n" + plain(option.get_description()) + "\n";
}

std::string synopsis_of(const CLI::App& command) {
    std::string text = bold("raylane " + command.get_name());
    if (!options_of(command).empty()) text += " [" + italic("options") + "]";
    for (const CLI::Option* option : positionals_of(command)) {
        const std::string name = italic(option->get_name());
        text += option->get_required() ? " " + name : " [" + name + "]";
    }
    return text;
}

void add_options_to(std::string& page, const CLI::App& command) {
    std::string group = "Options";
    page += ".SH OPTIONS\n";
    for (const CLI::Option* option : options_of(command)) {
        if (option->get_group() != group) {
            group = option->get_group();
            page += ".SS " + plain(group) + "\n";
        }
        add_option_to(page, *option);
    }
}

void add_details_to(std::string& page, std::string_view footer) {
    const std::string_view details = footer.substr(0, footer.find("Example: "));
    if (!details.empty()) page += ".SH DESCRIPTION\n" + plain(details);
}

void add_examples_to(std::string& page, std::string_view footer) {
    constexpr std::string_view sign = "Example: ";
    for (std::string_view rest = footer; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        if (!line.starts_with(sign)) continue;
        page += ".SH EXAMPLES\n.EX\n" + plain(line.substr(sign.size()), true) + "\n.EE\n";
    }
}

} // namespace

std::vector<std::string> choices_of(const CLI::Option& option) {
    std::vector<std::string> choices;
    const std::string type = option.get_type_name();
    if (type.find('|') == std::string::npos) return choices;
    for (std::size_t begin = 0; begin <= type.size();) {
        const std::size_t end = std::min(type.find('|', begin), type.size());
        choices.push_back(type.substr(begin, end - begin));
        begin = end + 1;
    }
    return choices;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    return {commands.begin(), commands.end()};
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
    return command.get_options([](const CLI::Option* o) { return o->nonpositional(); });
}

std::vector<const CLI::Option*> positionals_of(const CLI::App& command) {
    return command.get_options([](const CLI::Option* o) { return o->get_positional(); });
}

bool is_flag(const CLI::Option& option) {
    return option.get_items_expected_max() == 0;
}

std::string manual_page(const CLI::App& app, const CLI::App& command) {
    const bool is_whole = &app == &command;
    const std::string name = is_whole ? "raylane" : "raylane-" + command.get_name();
    std::string page = ".TH " + in_capitals(plain(name, true)) + R"( 1 "" "raylane )" +
                       RAYLANE_VERSION + "\" \"Commands\"\n.SH NAME\n" + plain(name, true) +
                       " \\- " + plain(without_subject(command.get_description())) +
                       "\n.SH SYNOPSIS\n";
    if (is_whole) {
        page += bold("raylane") + " " + italic("command") + " [" + italic("options") + "] " +
                italic("...") + "\n.SH COMMANDS\n";
        for (const CLI::App* each : commands_of(app))
            page += ".TP\n" + synopsis_of(*each) + "\n" + plain(each->get_description()) + "\n";
    } else {
        page += synopsis_of(command) + "\n";
        if (!command.get_prefix_command()) add_details_to(page, command.get_footer());
        page += ".SH ARGUMENTS\n";
        for (const CLI::Option* option : positionals_of(command))
            page += ".TP\n" + italic(option->get_name()) + "\n" + plain(option->get_description()) +
                    "\n";
    }
    if (command.get_prefix_command()) // it has a custom help text
        page += ".SH OPTIONS\n.EX\n" + plain(command.get_footer(), true) + ".EE\n";
    else
        add_options_to(page, command);
    page += ".SH ENVIRONMENT\n";
    for (const auto& [variable, meaning] : environment)
        page += ".TP\n" + bold(variable) + "\n" + plain(meaning) + "\n";
    page += ".SH EXIT STATUS\n";
    for (const auto& [code, meaning] : exit_codes)
        page += ".TP\n" + bold(code) + "\n" + plain(meaning) + "\n";
    if (!command.get_prefix_command()) add_examples_to(page, command.get_footer());
    page += ".SH SEE ALSO\n";
    std::string others = is_whole ? "" : ".BR raylane (1)";
    for (const CLI::App* each : commands_of(app))
        if (each != &command)
            others.append(others.empty() ? "" : ",\n")
                .append(".BR raylane\\-" + plain(each->get_name(), true) + " (1)");
    return page + others + "\n";
}

} // namespace raylane::scenes
