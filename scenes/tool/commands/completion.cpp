#include "scenes/tool/commands/manual.hpp"

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

} // namespace

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
