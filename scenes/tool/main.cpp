#include "core/invalid_value.hpp"
#include "scenes/errors.hpp"
#include "scenes/tool/command.hpp"
#include "scenes/tool/interrupt.hpp"

#include <array>
#include <cstdio>
#include <new>

namespace raylane::scenes {

namespace {

enum ExitCode { done = 0, bad_input = 2, refused = 3 };

int complain(const std::string& message, ExitCode code) {
    std::fprintf(stderr, "raylane: %s\n", message.c_str());
    return code;
}

/// What is wrong with the command line, in one line.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    const std::string help =
        "; see raylane " + (chosen.empty() ? "" : command.get_name() + " ") + "--help";
    const std::vector<std::string> extras = app.remaining(/*recurse=*/true);
    if (extras.empty()) return printable(error.what(), 200) + help;

    std::string known_names;
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    if (chosen.empty())
        for (const CLI::App* subcommand : app.get_subcommands({}))
            names.push_back(subcommand->get_name());
    const std::string& extra = extras.front();
    return "unknown argument \"" + printable(extra) + "\"" +
           suggestion(extra, {names.begin(), names.end()}) + help;
}

int run(int argc, const char* const* argv) {
    CLI::App app("raylane draws scenes of spheres, cylinders, cones, boxes and other quadrics.",
                 "raylane");
    app.set_version_flag("--version", "raylane " RAYLANE_VERSION, "Print the version and exit");
    app.footer("Example: raylane render scenes/birthday.json -o birthday.png\n"
               "Exit codes: 0 done, 1 a comparison that differs, 2 bad input or usage, 3 the "
               "system refused.");
    app.require_subcommand(1);
    const std::array<Command, 3> commands = {add_render_command(app), add_info_command(app),
                                             add_compare_command(app)};
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& request) {
        return app.exit(request);
    } catch (const CLI::ParseError& error) {
        return complain(usage_message(app, error), bad_input);
    }
    for (const Command& command : commands)
        if (command.arguments->parsed()) return command.run();
    return bad_input;
}

} // namespace

} // namespace raylane::scenes

int main(int argc, char** argv) {
    using namespace raylane;
    scenes::catch_signals();
    try {
        const int code = scenes::run(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            throw scenes::SystemRefused("standard output", "write", errno);
        return code;
    } catch (const scenes::BadInput& error) {
        return scenes::complain(error.what(), scenes::bad_input);
    } catch (const core::InvalidValue& error) {
        return scenes::complain(error.what(), scenes::bad_input);
    } catch (const std::bad_alloc&) {
        return scenes::complain("not enough memory", scenes::refused);
    } catch (const std::exception& error) {
        return scenes::complain(error.what(), scenes::refused);
    }
}
