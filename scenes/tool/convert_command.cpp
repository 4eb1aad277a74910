#include "scenes/errors.hpp"
#include "scenes/export/export.hpp"
#include "scenes/tool/arguments.hpp"
#include "scenes/tool/command.hpp"
#include "scenes/tool/drawing_arguments.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/scene_arguments.hpp"

#include <cstdio>
#include <memory>
#include <utility>

namespace raylane::scenes {

namespace {

struct ConvertArguments {
    Argument scene, output;
    SceneArguments scene_arguments;
};

int convert(const ConvertArguments& arguments) {
    const std::string& scene = file_argument("SCENE", *arguments.scene);
    const std::string& output = file_argument("OUTPUT", *arguments.output);
    require_other_than_scene("OUTPUT", output, scene);
    require_scene_ending(output);
    const Verbosity verbosity = arguments.scene_arguments.verbosity.verbosity();
    std::string differences;
    const ViewChange change = arguments.scene_arguments.view.change();
    core::Scene loaded =
        load_with_progress(scene, arguments.scene_arguments.load_options(), verbosity);
    const core::Settings settings = loaded.settings();
    for (const std::string& what : export_scene(output, seen(std::move(loaded), change, settings)))
        differences.append(differences.empty() ? "" : ", ").append(what);
    if (!differences.empty() && verbosity != Verbosity::quiet)
        std::fprintf(stderr, "%s: differs from the scene, because the format cannot express: %s\n",
                     printable(output, 4096).c_str(), differences.c_str());
    return 0;
}

} // namespace

Command add_convert_command(CLI::App& app) {
    CLI::App& command = add_command(app, "convert", "Write a scene in another format",
                                    "raylane convert scenes/lattice.json lattice.pov");
    auto arguments = std::make_shared<ConvertArguments>();
    add_positional(command, "SCENE", arguments->scene,
                   "Scene or atoms, in any format that render reads; - is standard input.");
    add_positional(command, "OUTPUT", arguments->output,
                   "Output file, .json, .nff, .pov (POV-Ray 3.7) or .rl (same as build); - writes "
                   "JSON to standard output.");
    arguments->scene_arguments.add_to(command);
    return {&command, [arguments] { return convert(*arguments); }};
}

} // namespace raylane::scenes
