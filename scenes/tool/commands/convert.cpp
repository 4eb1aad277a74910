#include "scenes/errors.hpp"
#include "scenes/export/export.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/files.hpp"
#include "scenes/tool/options/scene_options.hpp"

#include <cstdio>

namespace raylane::scenes {

namespace {

struct ConvertArguments : OptionTable {
    Option<std::string> scene = {*this, "SCENE", file_argument(), any_scene};
    Option<std::string> output = {*this, "OUTPUT", file_argument(),
                                  "Output file, .json, .nff, .pov (POV-Ray 3.7) or .rl (same "
                                  "as build); - writes JSON to standard output."};
    SceneArguments scene_arguments{*this};
};

int convert(const ConvertArguments& arguments) {
    const std::string& output = *arguments.output;
    require_other_than_scene("OUTPUT", output, *arguments.scene);
    require_scene_ending(output);
    const core::Scene scene = load_seen(*arguments.scene, arguments.scene_arguments);
    std::string differences;
    for (const std::string& what : export_scene(output, scene))
        differences.append(differences.empty() ? "" : ", ").append(what);
    if (!differences.empty() && !arguments.scene_arguments.verbosity.quiet)
        std::fprintf(stderr, "%s: differs from the scene, because the format cannot express: %s\n",
                     printable(output, 4096).c_str(), differences.c_str());
    return 0;
}

} // namespace

Command add_convert_command(CLI::App& app) {
    return add_command<ConvertArguments>(
        app,
        {.name = "convert",
         .help = "Write a scene in another format",
         .example = "raylane convert scenes/lattice.json lattice.pov"},
        convert);
}

} // namespace raylane::scenes
