#include "scenes/errors.hpp"
#include "scenes/export/export.hpp"
#include "scenes/tool/arguments.hpp"
#include "scenes/tool/command.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/output_name.hpp"
#include "scenes/tool/scene_arguments.hpp"

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

namespace raylane::scenes {

namespace {

struct BuildArguments {
    Argument scene, output, threads;
    SceneArguments scene_arguments;
};

int build(const BuildArguments& arguments) {
    const std::string& scene = file_argument("SCENE", *arguments.scene);
    const std::string output = arguments.output ? file_argument("--output", *arguments.output)
                                                : default_output(scene, ".rl");
    require_other_than_scene("--output", output, scene);
    if (!output.ends_with(".rl"))
        throw BadInput("--output", "", "must end in .rl, got \"" + printable(output) + '"');
    const Verbosity verbosity = arguments.scene_arguments.verbosity.verbosity();
    const ViewChange change = arguments.scene_arguments.view.change();
    core::Scene loaded = load_with_progress(scene, arguments.scene_arguments.load_options(),
                                            verbosity, threads_argument(arguments.threads));
    const core::Settings settings = loaded.settings();
    const core::Scene built = seen(std::move(loaded), change, settings);
    export_scene(output, built);
    if (verbosity == Verbosity::verbose)
        std::fprintf(stderr, "%s: %zu shapes, %.1f bytes each\n", printable(output, 4096).c_str(),
                     built.shape_count(),
                     built.shape_count() == 0 ? 0.0
                                              : static_cast<double>(built.bytes()) /
                                                    static_cast<double>(built.shape_count()));
    return 0;
}

} // namespace

Command add_build_command(CLI::App& app) {
    CLI::App& command =
        add_command(app, "build", "Build a large scene once, for many renders",
                    "raylane build scenes/lattice.json -o lattice.rl",
                    "All commands accept the output as a scene, without reading and building it "
                    "again. They map it into memory, once for all processes of a host.");
    auto arguments = std::make_shared<BuildArguments>();
    add_positional(command, "SCENE", arguments->scene,
                   "Scene or atoms, in any format that render reads; - is standard input.");
    add_option(command, "-o,--output", arguments->output,
               "Output file, .rl. Default: the scene's name with .rl, in the current folder.",
               "FILE");
    add_option(command, "--threads", arguments->threads,
               "Number of threads. Default: all processors.", "N");
    arguments->scene_arguments.add_to(command);
    return {&command, [arguments] { return build(*arguments); }};
}

} // namespace raylane::scenes
