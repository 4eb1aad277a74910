#include "scenes/tool/command.hpp"

namespace raylane::scenes {

CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& help,
                      const std::string& example, const std::string& details) {
    CLI::App* const command = app.add_subcommand(name, help);
    command->footer((details.empty() ? "" : details + "\n") + "Example: " + example);
    return *command;
}

bool take_options(const std::string& text, const std::function<void(CLI::App& command)>& add) {
    CLI::App command;
    add(command);
    try {
        command.parse(text);
    } catch (const CLI::RequiredError&) { // thrown before unknown options are reported
        return command.remaining().empty();
    } catch (const CLI::ParseError&) {
        return false;
    }
    return true;
}

CLI::Option* add_option(CLI::App& command, const std::string& names, Argument& value,
                        const std::string& help, const std::string& type) {
    // CLI11 itself would treat an empty text as a missing value.
    const auto take = [&value](const std::string& text) { value = text; };
    return command.add_option_function<std::string>(names, take, help)->type_name(type);
}

void add_positional(CLI::App& command, const std::string& name, Argument& value,
                    const std::string& help) {
    add_option(command, name, value, help, "")->required();
}

void add_flag(CLI::App& command, const std::string& name, bool& value, const std::string& help) {
    command.add_flag(name, value, help)->disable_flag_override();
}

} // namespace raylane::scenes
