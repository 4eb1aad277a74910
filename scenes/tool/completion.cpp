#include "scenes/tool/manual.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text.append(text.empty() ? "" : " ").append(word);
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

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const CLI::App* command : commands)
        names.push_back(command->get_name());
    return names;
}

bool takes_file(const CLI::Option& option) {
    return option.get_type_name() == "FILE";
}

/// Quotes a text for a shell. A text in single quotes cannot contain one, so each is escaped
/// outside.
std::string in_quotes(std::string_view text) {
    std::string result = "'";
    for (const char c : text)
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

/// Returns the first sentence or clause of the description, which fits beside a name.
std::string brief(const CLI::Option& option) {
    const std::string& text = option.get_description();
    const std::size_t end = std::min(text.find_first_of(":;("), text.size());
    return text.substr(0, text.find_last_not_of(' ', end - 1) + 1);
}

/// Returns a pattern for a `case`, such as "render:-o|render:--output".
std::string bash_pattern(const CLI::App& command, const CLI::Option& option) {
    std::string pattern;
    for (const std::string& name : names_of(option))
        pattern.append(pattern.empty() ? "" : "|").append(command.get_name() + ":" + name);
    return pattern;
}

/// Returns branches of a `case` for the values of options. Numbers and other free text have no
/// completions.
std::string bash_values(const CLI::App& app) {
    std::string chosen, others;
    for (const CLI::App* command : commands_of(app))
        for (const CLI::Option* option : options_of(*command)) {
            if (is_flag(*option) || takes_file(*option)) continue;
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

std::string bash_script(const CLI::App& app) {
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

std::string zsh_spec(const CLI::Option& option) {
    const std::vector<std::string> names = names_of(option);
    std::string all;
    for (const std::string& name : names)
        all.append(all.empty() ? "" : ",")
            .append(name + (is_flag(option)          ? ""
                            : name.starts_with("--") ? "="
                                                     : "+")); // "-o FILE" or "-oFILE"
    std::string what = brief(option);
    for (const char special : {'[', ']', ':'})
        std::replace(what.begin(), what.end(), special, ' ');
    std::string spec = names.size() > 1 ? "'(" + joined(names) + ")'{" + all + "}" : all;
    std::string rest = "[" + what + "]";
    if (!is_flag(option)) {
        const std::vector<std::string> choices = choices_of(option);
        rest += ":" + (choices.empty() ? option.get_type_name() : std::string("choice")) + ":";
        if (!choices.empty()) rest += "(" + joined(choices) + ")";
        if (takes_file(option)) rest += "_files";
    }
    return spec + in_quotes(rest);
}

std::string zsh_script(const CLI::App& app) {
    std::string commands, cases;
    for (const CLI::App* command : commands_of(app)) {
        commands +=
            "        " + in_quotes(command->get_name() + ":" + command->get_description()) + "\n";
        if (command->get_prefix_command()) { // it parses its arguments itself
            cases += "        " + command->get_name() + ") _files ;;\n";
            continue;
        }
        cases += "        " + command->get_name() + ") _arguments";
        for (const CLI::Option* option : options_of(*command))
            cases += " \\\n            " + zsh_spec(*option);
        for (const CLI::Option* option : positionals_of(*command)) {
            const std::vector<std::string> choices = choices_of(*option);
            cases +=
                " \\\n            " +
                in_quotes(std::string(option->get_required() ? ":" : "::") + option->get_name() +
                          ":" + (choices.empty() ? "_files" : "(" + joined(choices) + ")"));
        }
        cases += " ;;\n";
    }
    return "#compdef raylane\n"
           "# zsh completion of raylane, made by `raylane completion zsh`\n"
           "_raylane() {\n"
           "    local -a commands=(\n" +
           commands +
           "    )\n"
           "    if (( CURRENT == 2 )); then\n"
           "        _describe command commands\n"
           "        return\n"
           "    fi\n"
           "    local command=$words[2]\n"
           "    shift words\n"
           "    (( CURRENT-- ))\n"
           "    case $command in\n" +
           cases +
           "    esac\n"
           "}\n"
           "compdef _raylane raylane\n";
}

std::string fish_script(const CLI::App& app) {
    std::string text = "# fish completion of raylane, made by `raylane completion fish`\n";
    for (const CLI::App* command : commands_of(app))
        text += "complete -c raylane -n __fish_use_subcommand -f -a " + command->get_name() +
                " -d " + in_quotes(command->get_description()) + "\n";
    for (const CLI::App* command : commands_of(app)) {
        const std::string start =
            "complete -c raylane -n '__fish_seen_subcommand_from " + command->get_name() + "'";
        for (const CLI::Option* option : options_of(*command)) {
            text += start;
            for (const std::string& name : option->get_snames())
                text += " -s " + name;
            for (const std::string& name : option->get_lnames())
                text += " -l " + name;
            if (!is_flag(*option)) text += takes_file(*option) ? " -r -F" : " -x";
            if (const auto choices = choices_of(*option); !choices.empty())
                text += " -a " + in_quotes(joined(choices));
            text += " -d " + in_quotes(brief(*option)) + "\n";
        }
        for (const CLI::Option* option : positionals_of(*command))
            if (const auto choices = choices_of(*option); !choices.empty())
                text += start + " -f -a " + in_quotes(joined(choices)) + "\n";
    }
    return text;
}

} // namespace

std::string completion_script(const CLI::App& app, Shell shell) {
    switch (shell) {
    case Shell::bash:
        return bash_script(app);
    case Shell::zsh:
        return zsh_script(app);
    case Shell::fish:
        break;
    }
    return fish_script(app);
}

} // namespace raylane::scenes
