#include "scenes/atomic_file.hpp"
#include "scenes/image/exr.hpp"
#include "scenes/library/raylane/version.h"
#include "scenes/number.hpp"
#include "scenes/tool/command.hpp"
#include "scenes/tool/film_strip_arguments.hpp"
#include "scenes/tool/image_texts.hpp"
#include "scenes/tool/interrupt.hpp"
#include "scenes/tool/journal/fingerprint.hpp"
#include "scenes/tool/journal/resumable.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/command_line.hpp"
#include "scenes/tool/options/files.hpp"
#include "scenes/tool/options/render_options.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "scenes/tool/ranks/job.hpp"
#include "scenes/tool/ranks/shared_scene.hpp"
#include "simd/render.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

namespace raylane::scenes {

namespace {

class Stopwatch {
  public:
    /// Returns the seconds since construction or the last call.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - start_).count();
        start_ = now;
        return seconds;
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

struct Times {
    double load, render, write;
};

/// The work of a rendering.
struct Work {
    const simd::EngineCounters& counters; ///< of the whole picture, including earlier runs
    std::uint64_t rays_now;               ///< without rays of tiles from a checkpoint
    std::int64_t pixels;
    int ranks;

    /// Returns the mean number of samples, which differs by pixel for a quality. A part may have no
    /// pixels.
    double samples_per_pixel() const {
        return static_cast<double>(counters.primary) /
               static_cast<double>(std::max<std::int64_t>(1, pixels));
    }
};

struct Files {
    explicit Files(const RenderArguments& arguments)
        : scene(*arguments.scene), output(output_of(arguments)), stats(arguments.stats.value()) {
        require_other_than_scene("--output", output, scene);
        if (!stats) return;
        require_other_than_scene("--stats", *stats, scene);
        require_other_output("--stats", *stats, "--output", output);
    }

    std::string scene;
    std::string output; ///< for a frame: with number 0, until its number is known
    std::optional<std::string> stats;

  private:
    std::string output_of(const RenderArguments& arguments) const {
        if (arguments.frames.is_one())
            return picture_names(scene, arguments.output.value(), true)(0);
        return arguments.output.value_or(default_output(scene, ".png"));
    }
};

std::string_view isa_in_use(const simd::RenderOptions& options) {
    return options.engine == simd::Engine::vector ? simd::name_of(options.isa) : "none";
}

nlohmann::ordered_json stats_of(const RenderArguments& arguments, const core::Scene& scene,
                                const core::Settings& settings, const simd::RenderOptions& options,
                                const Work& work, const Times& times,
                                const std::string& scene_fingerprint,
                                const std::string& pixels_fingerprint) {
    const simd::EngineCounters& counters = work.counters;
    return {{"version", RAYLANE_VERSION},
            {"scene", printable(*arguments.scene, 4096)},
            {"engine", arguments.engine.text()},
            {"isa", isa_in_use(options)},
            {"precision", core::name_of(options.precision)},
            {"threads", options.threads},
            {"ranks", work.ranks},
            {"width", settings.width},
            {"height", settings.height},
            {"quality", as_printed(settings.quality)},
            {"samples_per_pixel", work.samples_per_pixel()},
            {"max_depth", settings.max_depth},
            {"min_weight", as_printed(settings.min_weight)},
            {"scene_fingerprint", scene_fingerprint},
            {"options_fingerprint", fingerprint_of_options(settings, options)},
            {"pixels_fingerprint", pixels_fingerprint},
            {"shapes", scene.shape_count()},
            {"scene_bytes", scene.bytes()},
            {"seconds", {{"load", times.load}, {"render", times.render}, {"write", times.write}}},
            {"rays",
             {{"primary", counters.primary},
              {"reflected", counters.reflected},
              {"refracted", counters.refracted},
              {"passed", counters.passed},
              {"shadow", counters.shadow},
              {"total", counters.rays()}}},
            {"rays_per_second", static_cast<double>(work.rays_now) / times.render},
            {"nodes_visited", counters.nodes},
            {"shapes_tested", counters.shapes},
            {"tests_beyond_double", counters.widened},
            {"shadow_rays_walked", counters.walked},
            {"searches",
             {{"shape_by_shape", counters.one_by_one},
              {"frusta", counters.in_frusta},
              {"lists", counters.in_lists},
              {"in_flight", counters.in_flight}}},
            {"rays_refined", counters.refined},
            {"left_to_the_reference", {{"rays", counters.doubtful}, {"paths", counters.followed}}}};
}

/// Returns the encoding and the texts of an image, which name the options that render it again.
PictureOptions picture_options(const RenderArguments& arguments, const Rendered& rendered,
                               int bits) {
    PictureOptions options{
        rendered.settings.transfer, bits, arguments.picture.encoding.dpi.value(), {}};
    if (*arguments.scene != "-")
        options.texts.emplace_back(
            "Title", printable(std::filesystem::path(*arguments.scene).filename().string(), 4096));
    options.texts.emplace_back("Software", "raylane " RAYLANE_VERSION);
    options.texts.emplace_back("Comment", text_of(arguments.recorded(rendered)));
    return options;
}

/// Throws BadInput unless a part is written as EXR with 32 bits: it must keep the floats of the
/// whole picture.
void require_fit(const std::optional<ImagePart>& part, int bits, PictureFormat format) {
    if (!part) return;
    if (format != PictureFormat::exr)
        throw BadInput("--part", "", "goes with an output that ends in .exr");
    if (bits != 32) throw BadInput("--part", "", "goes with --bits 32");
}

/// Returns the share of a film's pictures for this rank of a part. The ranks of a part take turns,
/// as the parts do.
FilmStrip::Share share_of(const Job& job, const ImagePart& part) {
    return {part.number - 1 + part.count * static_cast<std::size_t>(job.rank()),
            part.count * static_cast<std::size_t>(job.size())};
}

int render(const RenderArguments& arguments) {
    simd::RenderOptions options = arguments.render_options();
    const PictureArguments& picture = arguments.picture;
    int bits = picture.encoding.bits.value_or(0);
    const std::optional<ImagePart>& part_asked = arguments.part.value();
    std::optional<ImagePart> part_of_tiles;
    const LoadOptions load_options = arguments.scene_arguments.load_options();
    const ViewChange change = arguments.scene_arguments.view.change();
    const Files files(arguments);
    const Verbosity asked = arguments.scene_arguments.verbosity.verbosity();

    Job job;
    const Verbosity verbosity = job.is_first() ? asked : Verbosity::quiet;
    const int threads_to_load = options.threads;
    if (!arguments.threads) options.threads = job.share_of_threads(options.threads);
    const bool is_frame = arguments.frames.is_one(); // drawn as a single scene
    std::optional<FilmStrip> strip;                  // the ranks take its pictures in turn
    std::optional<std::size_t> place;                // the picture's place in a film
    const auto resumable = [&](const std::string& name, const core::Scene& scene,
                               const core::Settings& settings, const std::string& fingerprint) {
        const bool is_resumable = !arguments.no_resume && (strip || job.is_first());
        return ResumableRendering(name, is_resumable, scene, fingerprint, settings, options,
                                  part_of_tiles, verbosity);
    };
    const auto write = [&](ResumableRendering& drawing, OutputFile& output,
                           const simd::Rendering& rendering, const core::Settings& settings,
                           const core::Settings& own, const std::string& fingerprint) {
        // The images of a sequence may have different sizes.
        PictureOptions how =
            picture_options(arguments, {settings, own, options, !strip || arguments.size}, bits);
        if (place) how.texts.emplace_back("Film", std::to_string(*place));
        if (part_of_tiles)
            how.texts.emplace_back("Part", part_of_tiles->text() + " of tiles of " +
                                               std::to_string(simd::tile_of(settings, options)));
        how.texts.emplace_back("Scene", fingerprint);
        how.texts.emplace_back("Options", fingerprint_of_options(settings, options));
        std::string pixels = fingerprint_of(rendering.film);
        how.texts.emplace_back("Pixels", pixels);
        how.texts.emplace_back("Rays", RayTiers(rendering.counters).text());
        drawing.write(output, rendering.film, how,
                      picture.layers.is_given() ? &rendering.layers : nullptr);
        return pixels;
    };
    if (files.scene == "-") job.share_standard_input();
    job.together([&] {
        if (!is_frame) strip = film_strip_of(arguments, options.threads, verbosity);
        if (files.stats && strip)
            throw BadInput(
                "--stats", "",
                "goes with a single image, without --turn, ranges of --frames and sweeps of --set");
        if (!strip) return;
        const OutputFile writable(strip->name(0), exr_of); // throws at once if it cannot be written
        picture.require_fit(writable.format());
    });
    if (strip) {
        strip->share = share_of(job, part_asked.value_or(ImagePart{1, 1}));
        strip->draw = [&](const core::Scene& scene, std::size_t at, const std::string& name,
                          simd::Progress& progress) {
            place = at;
            OutputFile output(name, exr_of);
            output.be_durable(); // a resumed film takes existing files as complete
            const core::Settings settings = arguments.settings_of(scene.settings());
            picture.apply_to(options, settings);
            const std::string fingerprint = fingerprint_of(scene);
            ResumableRendering drawing = resumable(name, scene, settings, fingerprint);
            write(drawing, output, drawing.draw(progress), settings, scene.settings(), fingerprint);
            drawing.finished();
            drawing.end_if_signalled();
        };
        if (!arguments.no_resume && job.is_first())
            say_when_ended("raylane: stopped between images; existing images are complete\n");
        job.together([&] { draw(*strip); });
        say_when_ended(nullptr);
        return 0;
    }
    part_of_tiles = part_asked;
    if (part_of_tiles && bits == 0) bits = 32;
    std::optional<OutputFile> output;
    std::optional<AtomicFile> stats;
    std::optional<core::Scene> loaded;
    std::string fingerprint;
    core::Settings settings;
    Stopwatch stopwatch;
    job.together([&] {
        if (!job.is_first()) return;
        output.emplace(files.output, exr_of);
        require_fit(part_of_tiles, bits, output->format());
        picture.require_fit(output->format());
        if (files.stats) stats.emplace(*files.stats);
    });
    std::string name = files.output;
    if (is_frame) place = 0;
    loaded = load_together(job, files.scene, threads_to_load, [&](int threads) {
        if (!is_frame) return load_with_progress(files.scene, load_options, verbosity, threads);
        Shot shot = first_shot(*film_strip_of(arguments, threads, verbosity));
        name = std::move(shot.name);
        return std::move(shot.scene);
    });
    job.together([&] {
        settings = arguments.settings_of(loaded->settings());
        if (!is_frame) loaded = seen(*std::move(loaded), change, settings);
        // The number in the frame's file name is known only now.
        if (output && name != files.output) {
            if (stats) require_other_output("--stats", *files.stats, "--output", name);
            output.emplace(name, exr_of);
        }
        picture.apply_to(options, settings);
        fingerprint = fingerprint_of(*loaded);
    });
    const core::Scene& scene = *loaded;
    job.require_same(fingerprint +
                         text_of(arguments.recorded({settings, scene.settings(), options, true})),
                     "the scene");
    const core::Region part =
        options.crop.value_or(core::Region{0, 0, settings.width, settings.height});
    if (output) output->reserve(part.x1 - part.x0, part.y1 - part.y0);
    Times times{};
    times.load = stopwatch.lap();

    simd::Progress progress;
    ResumableRendering drawing = resumable(name, scene, settings, fingerprint);
    const simd::Rendering rendering = [&] {
        const ProgressBar bar(verbosity, progress,
                              simd::drawn_part(settings, options.crop).pixels());
        return drawing.draw(progress, &job);
    }();
    if (!job.is_first()) return 0;
    times.render = stopwatch.lap();

    const std::string pixels =
        write(drawing, *output, rendering, settings, scene.settings(), fingerprint);
    drawing.finished();
    times.write = stopwatch.lap();

    const Work work{rendering.counters, progress.rays, drawing.pixels(), job.size()};
    if (stats) {
        const std::string text =
            stats_of(arguments, scene, settings, options, work, times, fingerprint, pixels)
                .dump(2) +
            "\n";
        stats->write(text);
        stats->commit();
    }
    drawing.end_if_signalled();
    if (verbosity == Verbosity::verbose)
        std::fprintf(stderr, "%s engine, %s, %s precision, %d threads\n",
                     arguments.engine.text().c_str(), std::string(isa_in_use(options)).c_str(),
                     std::string(core::name_of(options.precision)).c_str(), options.threads);
    if (verbosity == Verbosity::verbose || (verbosity == Verbosity::normal && is_terminal()))
        std::fprintf(stderr, "%s: %d x %d pixels, %.8g samples each, in %s, %srays/s\n",
                     printable(name, 4096).c_str(), part.x1 - part.x0, part.y1 - part.y0,
                     std::round(100.0 * work.samples_per_pixel()) / 100.0,
                     duration_text(times.render).c_str(),
                     with_prefix(static_cast<double>(work.rays_now) / times.render).c_str());
    return 0;
}

} // namespace

Command add_render_command(CLI::App& app) {
    Command command =
        add_command<RenderArguments>(app,
                                     {.name = "render",
                                      .help = "Render an image of a scene",
                                      .example = "raylane render scenes/birthday.json -o "
                                                 "birthday.png --size 1000x1000 --spp 16"},
                                     render);
    command.by_ranks = true;
    return command;
}

} // namespace raylane::scenes
