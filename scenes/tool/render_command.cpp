#include "core/validate.hpp"
#include "scenes/atomic_file.hpp"
#include "scenes/image/writer.hpp"
#include "scenes/scene_file.hpp"
#include "scenes/tool/arguments.hpp"
#include "scenes/tool/command.hpp"
#include "scenes/tool/interrupt.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "simd/render.hpp"
#include "simd/tiles.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <thread>
#include <unistd.h>

namespace raylane::scenes {

namespace {

/// As they are on the command line; empty if not given.
struct RenderArguments {
    std::string scene, output, size, samples, max_depth, min_weight, threads, transfer, stats;
    std::string engine = "reference", real = "double";
};

class Stopwatch {
  public:
    /// Since construction or the last call.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - start_).count();
        start_ = now;
        return seconds;
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A file for the figures, that appears whole or not at all.
struct StatsFile {
    explicit StatsFile(const std::string& path)
        : file(path), removed_on_interrupt(file.temporary_path()) {}

    AtomicFile file;
    RemovedOnInterrupt removed_on_interrupt;
};

struct Times {
    double load, render, write;
};

std::filesystem::path output_path(const RenderArguments& arguments) {
    if (!arguments.output.empty()) return arguments.output;
    return std::filesystem::path(arguments.scene).stem().concat(".png");
}

/// Parsed before the scene is loaded, so that a mistake shows at once.
struct Overrides {
    explicit Overrides(const RenderArguments& arguments) {
        using core::Settings;
        if (!arguments.size.empty())
            size = size_argument("--size", arguments.size, Settings::max_size);
        if (!arguments.samples.empty())
            grid = square_argument("--spp", arguments.samples, Settings::max_grid);
        if (!arguments.max_depth.empty())
            max_depth =
                whole_argument("--max-depth", arguments.max_depth, 0, Settings::depth_limit);
        if (!arguments.min_weight.empty())
            min_weight = number_argument("--min-weight", arguments.min_weight, 0.0F, 1.0F);
        if (!arguments.transfer.empty())
            transfer = choice_argument<core::Transfer>(
                "--transfer", arguments.transfer,
                {{"srgb", core::Transfer::srgb}, {"linear", core::Transfer::linear}});
    }

    core::Settings applied_to(core::Settings settings) const {
        if (size) std::tie(settings.width, settings.height) = *size;
        settings.grid = grid.value_or(settings.grid);
        settings.max_depth = max_depth.value_or(settings.max_depth);
        settings.min_weight = min_weight.value_or(settings.min_weight);
        settings.transfer = transfer.value_or(settings.transfer);
        return settings;
    }

    std::optional<std::pair<int, int>> size;
    std::optional<int> grid, max_depth;
    std::optional<float> min_weight;
    std::optional<core::Transfer> transfer;
};

simd::RenderOptions options_of(const RenderArguments& arguments) {
    simd::RenderOptions options;
    options.engine = choice_argument<simd::Engine>("--engine", arguments.engine,
                                                   {{"reference", simd::Engine::reference}});
    options.precision =
        choice_argument<simd::Precision>("--real", arguments.real,
                                         {{"float", simd::Precision::single_precision},
                                          {"double", simd::Precision::double_precision}});
    if (!arguments.threads.empty())
        options.threads = whole_argument("--threads", arguments.threads, 1, simd::max_threads);
    return options;
}

nlohmann::ordered_json stats_of(const RenderArguments& arguments, const core::Scene& scene,
                                const core::Settings& settings, const core::Counters& counters,
                                const Times& times) {
    const auto count = static_cast<double>(counters.rays());
    return {{"version", RAYLANE_VERSION},
            {"scene", printable(arguments.scene, 4096)},
            {"engine", arguments.engine},
            {"real", arguments.real},
            {"threads", arguments.threads.empty()
                            ? simd::default_threads()
                            : whole_argument("--threads", arguments.threads, 1, simd::max_threads)},
            {"width", settings.width},
            {"height", settings.height},
            {"samples_per_pixel", settings.grid * settings.grid},
            {"max_depth", settings.max_depth},
            {"min_weight", to_decimal(settings.min_weight)},
            {"shapes", scene.shape_count()},
            {"scene_bytes", scene.bytes()},
            {"seconds", {{"load", times.load}, {"render", times.render}, {"write", times.write}}},
            {"rays",
             {{"primary", counters.primary},
              {"reflected", counters.reflected},
              {"refracted", counters.refracted},
              {"shadow", counters.shadow},
              {"total", counters.rays()}}},
            {"rays_per_second", count / times.render},
            {"nodes_visited", counters.nodes},
            {"shapes_tested", counters.shapes},
            {"tests_beyond_double", counters.widened}};
}

int render(const RenderArguments& arguments) {
    const Overrides overrides(arguments);
    simd::RenderOptions options = options_of(arguments);
    OutputFile output(output_path(arguments));
    const RemovedOnInterrupt output_removed_on_interrupt(output.temporary_path());
    std::unique_ptr<StatsFile> stats;
    if (!arguments.stats.empty()) stats = std::make_unique<StatsFile>(arguments.stats);

    Stopwatch stopwatch;
    const core::Scene scene = load_scene(arguments.scene);
    const core::Settings settings = overrides.applied_to(scene.settings());
    core::validate(settings);
    output.reserve(settings.width, settings.height);
    Times times{};
    times.load = stopwatch.lap();

    simd::Progress progress;
    options.progress = &progress;
    const simd::Rendering rendering = [&] {
        const ProgressBar bar(progress, std::int64_t{settings.width} * settings.height);
        return simd::render(scene, settings, options);
    }();
    times.render = stopwatch.lap();

    output.commit(rendering.film, settings.transfer);
    times.write = stopwatch.lap();

    if (stats) {
        const std::string text =
            stats_of(arguments, scene, settings, rendering.counters, times).dump(2) + "\n";
        stats->file.write(text);
        stats->file.commit();
    }
    if (::isatty(STDERR_FILENO) == 1)
        std::fprintf(
            stderr, "%s: %d x %d pixels, %d samples each, in %s, %srays/s\n",
            output_path(arguments).c_str(), settings.width, settings.height,
            settings.grid * settings.grid, duration_text(times.render).c_str(),
            with_prefix(static_cast<double>(rendering.counters.rays()) / times.render).c_str());
    return 0;
}

} // namespace

Command add_render_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Draw the picture of a scene");
    auto arguments = std::make_shared<RenderArguments>();
    const auto add = [&](const char* names, std::string& value, const char* help,
                         const char* type) {
        command->add_option(names, value, help)->type_name(type);
    };
    command->add_option("SCENE", arguments->scene, "A scene in JSON or NFF")
        ->required()
        ->type_name("");
    add("-o,--output", arguments->output,
        "The picture: .png, .hdr or .pfm (default: the scene's name, .png)", "FILE");
    add("--size", arguments->size, "Pixels (default: as the scene says)", "WxH");
    add("--spp", arguments->samples,
        "Samples per pixel, a square number (default: as the scene says)", "N");
    add("--max-depth", arguments->max_depth,
        "Reflections and refractions one after the other (default: as the scene says)", "N");
    add("--min-weight", arguments->min_weight,
        "Leave paths of less influence on the pixel (default: as the scene says)", "W");
    add("--threads", arguments->threads, "Threads (default: all processors)", "N");
    add("--engine", arguments->engine, "What traces: reference (default: reference)", "NAME");
    add("--real", arguments->real, "The reference's numbers: float or double (default: double)",
        "TYPE");
    add("--transfer", arguments->transfer,
        "From light to PNG: srgb or linear (default: as the scene says)", "CURVE");
    add("--stats", arguments->stats, "Write figures about the rendering as JSON", "FILE");
    command->footer("Example: raylane render scenes/birthday.json -o birthday.png --size 1000x1000 "
                    "--spp 16");
    return {command, [arguments] { return render(*arguments); }};
}

} // namespace raylane::scenes
