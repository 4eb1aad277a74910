#include "scenes/tool/commands/manual.hpp"

#include "scenes/api/cpp/raylane/version.h"
#include "scenes/tool/commands/command.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace raylane::scenes {

namespace {

/// Returns the options with dashes, in the order of the help.
std::vector<const CLI::Option*> options_of(const CLI::App& command) {
    return command.get_options([](const CLI::Option* o) { return o->nonpositional(); });
}

std::vector<const CLI::Option*> positionals_of(const CLI::App& command) {
    return command.get_options([](const CLI::Option* o) { return o->get_positional(); });
}

/// Returns true for an option without a value.
bool is_flag(const CLI::Option& option) {
    return option.get_items_expected_max() == 0;
}

/// Returns the choices in an option's type name: "vector" and "reference" for "vector|reference",
/// none for "N".
std::vector<std::string> choices_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::vector<std::string_view> parts = parts_of(type, '|');
    if (parts.size() == 1) return {};
    return {parts.begin(), parts.end()};
}

std::string joined(const std::vector<std::string>& words, const char* separator = " ") {
    std::string text;
    for (const std::string& word : words)
        text.append(text.empty() ? "" : separator).append(word);
    return text;
}

/// Returns the names of an option, such as "-o" and "--output".
std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    return names;
}

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
    std::vector<std::string> bold_names;
    for (const std::string& name : names_of(option))
        bold_names.push_back(bold(name));
    std::string names = joined(bold_names, ", ");
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

/// Begins each line of a footer that is an example.
constexpr std::string_view example = "Example: ";

void add_details_to(std::string& page, std::string_view footer) {
    const std::string_view details = footer.substr(0, footer.find(example));
    if (!details.empty()) page += ".SH DESCRIPTION\n" + plain(details);
}

void add_examples_to(std::string& page, std::string_view footer) {
    for (std::string_view rest = footer; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        if (!line.starts_with(example)) continue;
        page += ".SH EXAMPLES\n.EX\n" + plain(line.substr(example.size()), true) + "\n.EE\n";
    }
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const CLI::App* command : commands)
        names.push_back(command->get_name());
    return names;
}

/// Returns a pattern for a `case`, such as "render:-o|render:--output".
std::string bash_pattern(const CLI::App& command, const CLI::Option& option) {
    std::vector<std::string> names = names_of(option);
    for (std::string& name : names)
        name.insert(0, command.get_name() + ":");
    return joined(names, "|");
}

/// Returns branches of a `case` for the values of options. Numbers and other free text have no
/// completions.
std::string bash_values(const CLI::App& app) {
    std::string chosen, others;
    for (const CLI::App* command : commands_of(app))
        for (const CLI::Option* option : options_of(*command)) {
            if (is_flag(*option) || option->get_type_name() == "FILE") continue;
            const std::string pattern = bash_pattern(*command, *option);
            if (const std::vector<std::string> choices = choices_of(*option); !choices.empty())
                chosen += "        " + pattern + ") words=\"" + joined(choices) + "\" ;;\n";
            else
                others.append(others.empty() ? "        " : "|\\\n        ").append(pattern);
        }
    return chosen + others + ") compopt +o default ;;\n";
}

/// Returns branches of a `case` for all other words: options, and arguments with choices.
std::string bash_words(const CLI::App& app) {
    std::string text;
    for (const CLI::App* command : commands_of(app)) {
        std::vector<std::string> options, choices;
        for (const CLI::Option* option : options_of(*command))
            for (std::string& name : names_of(*option))
                options.push_back(std::move(name));
        for (const CLI::Option* option : positionals_of(*command))
            for (std::string& choice : choices_of(*option))
                choices.push_back(std::move(choice));
        text +=
            "            " + command->get_name() + ":-*) words=\"" + joined(options) + "\" ;;\n";
        if (!choices.empty())
            text +=
                "            " + command->get_name() + ":*) words=\"" + joined(choices) + "\" ;;\n";
    }
    return text;
}

} // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    return {commands.begin(), commands.end()};
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

std::string completion_script(const CLI::App& app) {
    return "# bash completion of raylane, made by `raylane completion bash`\n"
           "_raylane() {\n"
           "    local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
           "    local command=\"${COMP_WORDS[1]}\" words=\n"
           "    [ \"$COMP_CWORD\" -gt 1 ] || command=\n"
           "    case \"$command:$before\" in\n"
           "        :*) words=\"" +
           joined(names_of(commands_of(app))) + " --help --version\" ;;\n" + bash_values(app) +
           "        *) case \"$command:$word\" in\n" + bash_words(app) +
           "        esac ;;\n"
           "    esac\n"
           "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
           "}\n"
           "complete -o default -F _raylane raylane\n";
}

} // namespace raylane::scenes
