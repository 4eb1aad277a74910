#include "scenes/export/export.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/option.hpp"
#include "scenes/tool/options/scene_options.hpp"

#include <cstdio>
#include <string>

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

struct BuildArguments : OptionTable {
    Option<std::string> scene = {*this, "SCENE", file_argument(), any_scene};
    Option<std::string> output = {
        *this, "-o,--output",
        file_name().otherwise("the scene's name with .rl, in the current folder"),
        "Output file, .rl."};
    ThreadsOption threads{*this};
    SceneArguments scene_arguments{*this};
};

int build(const BuildArguments& arguments) {
    const std::string output = arguments.output.value_or(default_output(*arguments.scene, ".rl"));
    require_other_than_scene("--output", output, *arguments.scene);
    if (!output.ends_with(".rl"))
        throw BadInput("--output", "", "must end in .rl, got \"" + printable(output) + '"');
    const core::Scene built =
        load_seen(*arguments.scene, arguments.scene_arguments, arguments.threads.count());
    export_scene(output, built);
    if (arguments.scene_arguments.verbosity.verbose)
        std::fprintf(stderr, "%s: %zu shapes, %.1f bytes each\n", printable(output, 4096).c_str(),
                     built.shape_count(),
                     built.shape_count() == 0 ? 0.0
                                              : static_cast<double>(built.bytes()) /
                                                    static_cast<double>(built.shape_count()));
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

Command add_build_command(CLI::App& app) {
    return add_command<BuildArguments>(
        app,
        {.name = "build",
         .help = "Build a large scene once, for many renders",
         .example = "raylane build scenes/lattice.json -o lattice.rl",
         .details = "All commands accept the output as a scene, without reading and building it "
                    "again. They map it into memory, once for all processes of a host."},
        build);
}

} // namespace raylane::scenes
