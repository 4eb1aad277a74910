#include "scenes/api/cpp/raylane/version.h"
#include "scenes/files/atomic_file.hpp"
#include "scenes/files/number.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/tool/annotator.hpp"
#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "scenes/tool/checkpoint/resumable.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/exit.hpp"
#include "scenes/tool/image_texts.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/command_line.hpp"
#include "scenes/tool/options/option.hpp"
#include "scenes/tool/options/render_options.hpp"
#include "scenes/tool/progress_bar.hpp"
#include "scenes/tool/ranks/job.hpp"
#include "scenes/tool/sequence/frame_sequence.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace raylane::scenes {

namespace {

std::string_view isa_in_use(const simd::RenderOptions& options) {
    return options.engine == simd::Engine::vector ? simd::name_of(options.isa) : "none";
}

/// The plan of this process: the image or the sequence that it renders, and how.
struct Plan {
    /// Joins the other ranks. Throws BadInput for options that are invalid with any scene.
    explicit Plan(const RenderArguments& given);

    /// Returns true if a sequence has a single frame, which is rendered like a single scene.
    bool is_frame() const { return arguments.frames.is_one(); }

    const RenderArguments& arguments;
    simd::RenderOptions options;
    std::string output;     ///< of a frame: with number 0, until its number is known
    std::size_t number = 0; ///< in names of files
    LoadOptions load_options;
    Job job; // joins after the checks above
    Verbosity verbosity;
    int threads_to_load;
    std::optional<FrameSequence> sequence; ///< a sequence, whose images the ranks take in turn
    std::optional<ImagePart> tiles;        ///< the part of a single image
    Annotator annotator;
    int bits; ///< per component; 0: the format's default
};

/// An image to render.
struct Target {
    const core::Scene& scene;
    core::Settings settings;
    std::string name;
    std::optional<std::size_t> place; ///< in a sequence
    std::string fingerprint;          ///< of the scene
};

/// The work for an image.
struct Work {
    double load = 0.0, render = 0.0, write = 0.0; ///< seconds
    simd::EngineCounters counters = {};           ///< of the whole image, including earlier runs
    std::uint64_t rays_now = 0;                   ///< without rays of tiles from a checkpoint
    double samples_per_pixel = 0.0;               ///< mean; it differs by pixel for a quality
    std::string pixels_fingerprint = {};

    double rays_per_second() const { return static_cast<double>(rays_now) / render; }
};

/// Returns the output of a single image.
std::string checked_output(const RenderArguments& arguments) {
    const std::string& scene = *arguments.scene;
    std::string output = arguments.frames.is_one()
                             ? image_names(scene, arguments.output.value(), true)(0)
                             : arguments.output.value_or(default_output(scene, ".png"));
    require_other_than_scene("--output", output, scene);
    if (arguments.stats) {
        require_other_than_scene("--stats", *arguments.stats, scene);
        require_other_output("--stats", *arguments.stats, "--output", output);
    }
    if (const auto& file = arguments.annotation.annotations) {
        if (!file->ends_with(".svg"))
            throw BadInput("--annotations", "",
                           "must end with .svg, got \"" + printable(*file) + '"');
        require_other_than_scene("--annotations", *file, scene);
        require_other_output("--annotations", *file, "--output", output);
        if (arguments.stats)
            require_other_output("--annotations", *file, "--stats", *arguments.stats);
    }
    return output;
}

Plan::Plan(const RenderArguments& given)
    : arguments(given), options(given.render_options()), output(checked_output(given)),
      load_options(given.scene_arguments.load_options()),
      verbosity(job.is_first() ? given.scene_arguments.verbosity.verbosity() : Verbosity::quiet),
      threads_to_load(options.threads), annotator(given),
      bits(given.image.encoding.bits.value_or(0)) {
    load_options.legend = annotator.legend();
    if (!given.threads) options.threads = job.share_of_threads(options.threads);
    if (*given.scene == "-") job.share_standard_input();
    job.together([&] {
        if (!is_frame()) sequence = requested_sequence(given, options.threads, verbosity);
        if (!sequence) return;
        sequence->wants_legends = annotator.has_any();
        if (given.stats)
            throw BadInput(
                "--stats", "",
                "goes with a single image, without --turn, ranges of --frames and sweeps of --set");
        const OutputFile writable(sequence->name(0),
                                  more_encoders); // throws at once if it cannot be written
        given.require_fit(writable.format());
    });
    if (sequence) {
        // The ranks of a part take turns, as the parts do.
        const ImagePart part = given.part.value_or({1, 1});
        sequence->share = {part.number - 1 + part.count * static_cast<std::size_t>(job.rank()),
                           part.count * static_cast<std::size_t>(job.size())};
    } else if (given.part) {
        annotator.require_whole();
        tiles = *given.part;
        if (bits == 0) bits = 32;
    }
}

/// Sets the crop and the AOVs in `plan`. The crop must be within the image.
Target target_of(Plan& plan, const core::Scene& scene, const std::string& name,
                 std::optional<std::size_t> place) {
    const core::Settings settings = plan.arguments.settings_of(scene.settings());
    plan.arguments.image.apply_to(plan.options, settings);
    return {scene, settings, name, place, fingerprint_of(scene)};
}

/// Returns the options that render the image again.
std::string comment_of(const Plan& plan, const Target& image) {
    // The images of a sequence may have different sizes.
    const bool names_size = !plan.sequence || plan.arguments.size;
    auto options =
        plan.arguments.recorded({image.settings, image.scene.settings(), plan.options, names_size});
    if (!plan.annotator.covers_image())
        std::erase_if(options, [&](const auto& option) {
            return plan.arguments.annotation.has(option.first);
        });
    return text_of_options(options);
}

/// Returns the encoding and the texts of the image.
ImageOptions image_options(const Plan& plan, const Target& image, const simd::Rendering& rendering,
                           const std::string& pixels) {
    const std::filesystem::path scene = *plan.arguments.scene;
    ImageOptions options{image.settings.transfer, plan.bits, plan.arguments.dpi(), {}};
    const auto add = [&](const char* key, const std::string& text) {
        options.texts.emplace_back(key, text);
    };
    if (scene != "-") add("Title", printable(scene.filename().string(), 4096));
    add("Software", "raylane " RAYLANE_VERSION);
    add("Comment", comment_of(plan, image));
    if (image.place) add("Film", std::to_string(*image.place));
    if (plan.tiles)
        add("Part", plan.tiles->text() + " of tiles of " +
                        std::to_string(simd::tile_of(image.settings, plan.options)));
    add("Scene", image.fingerprint);
    add("Options", fingerprint_of_options(image.settings, plan.options));
    add("Pixels", pixels);
    add("Rays", RayTiers(rendering.counters).text());
    return options;
}

/// Returns the rendering of the image, which may have a checkpoint.
ResumableRendering resumable(const Plan& plan, const Target& image) {
    const bool has_checkpoint = !plan.arguments.no_resume && (plan.sequence || plan.job.is_first());
    return {image.name,     has_checkpoint, image.scene, image.fingerprint,
            image.settings, plan.options,   plan.tiles,  plan.verbosity};
}

core::Region part_of(const Plan& plan, const Target& image) {
    return plan.options.crop.value_or(
        core::Region{0, 0, image.settings.width, image.settings.height});
}

/// Writes the image and returns the fingerprint of its pixels.
std::string write(const Plan& plan, const Target& image, ResumableRendering& drawing,
                  const simd::Rendering& rendering, OutputFile& output) {
    std::string pixels = fingerprint_of(rendering.film);
    std::optional<core::Film> covered;
    if (plan.annotator.covers_image())
        plan.annotator.cover(covered.emplace(rendering.film), part_of(plan, image),
                             image.settings.transfer);
    drawing.write(output, covered ? *covered : rendering.film,
                  image_options(plan, image, rendering, pixels),
                  plan.options.aovs ? &rendering.aovs : nullptr);
    drawing.finished();
    return pixels;
}

/// Returns a callback that prints remarks on standard error. Those that differ only in digits are
/// printed once, so not for each image of a sequence.
OnRemark remarks_of(const Plan& plan) {
    if (plan.verbosity == Verbosity::quiet) return {};
    const auto told = std::make_shared<std::set<std::string>>();
    return [told](const std::string& remark) {
        std::string words = remark;
        std::erase_if(words, [](char c) { return c >= '0' && c <= '9'; });
        if (told->insert(words).second)
            std::fprintf(stderr, is_terminal() ? "\r%s\x1B[K\n" : "%s\n", remark.c_str());
    };
}

void render_sequence(Plan& plan) {
    plan.sequence->draw = [&, on_remark = remarks_of(plan)](const SequenceImage& of,
                                                            simd::Progress& progress) {
        OutputFile output(of.name, more_encoders);
        output.be_durable(); // a resumed sequence takes existing files as complete
        const Target image = target_of(plan, of.scene, of.name, of.place);
        plan.annotator.compose(of.scene, of.legend, image.settings, on_remark);
        plan.annotator.write_file(of.number);
        ResumableRendering drawing = resumable(plan, image);
        write(plan, image, drawing, drawing.draw(progress), output);
        drawing.end_if_signalled();
    };
    if (!plan.arguments.no_resume && plan.job.is_first())
        say_when_ended("raylane: stopped between images; existing images are complete\n");
    plan.job.together([&] { draw(*plan.sequence); });
    say_when_ended(nullptr);
}

/// The files of a single image, which rank 0 writes.
struct Outputs {
    std::optional<OutputFile> image;
    std::optional<AtomicFile> stats;
};

/// Throws at once if a file cannot be written, or has a format that does not fit the options.
void open_outputs(Outputs& outputs, Plan& plan) {
    plan.job.together([&] {
        if (!plan.job.is_first()) return;
        const ImageFormat format = outputs.image.emplace(plan.output, more_encoders).format();
        if (plan.tiles && format != ImageFormat::exr)
            throw BadInput("--part", "", "goes with an output that ends in .exr");
        // A part must keep the floats of the whole image.
        if (plan.tiles && plan.bits != 32) throw BadInput("--part", "", "goes with --bits 32");
        plan.arguments.require_fit(format);
        if (plan.arguments.stats) outputs.stats.emplace(*plan.arguments.stats);
    });
}

/// Returns the scene with its view. Sets the name of a frame, whose number is known only now.
core::Scene load(Plan& plan, Outputs& outputs) {
    const RenderArguments& arguments = plan.arguments;
    std::string name = plan.output;
    std::optional<core::Scene> scene =
        load_together(plan.job, *arguments.scene, plan.threads_to_load, [&](int threads) {
            if (!plan.is_frame())
                return load_with_progress(*arguments.scene, plan.load_options, plan.verbosity,
                                          threads, arguments.isa.value());
            SequenceFrame frame = first_frame(
                *requested_sequence(arguments, threads, plan.verbosity), plan.annotator.legend());
            name = std::move(frame.name);
            plan.number = frame.number;
            return std::move(frame.scene);
        });
    plan.job.together([&] {
        const core::Settings settings = arguments.settings_of(scene->settings());
        if (!plan.is_frame())
            scene = seen(*std::move(scene), arguments.scene_arguments.view.change(), settings);
        if (!outputs.image || name == plan.output) return;
        if (outputs.stats) require_other_output("--stats", *arguments.stats, "--output", name);
        outputs.image.emplace(name, more_encoders);
    });
    plan.output = name;
    return *std::move(scene);
}

nlohmann::ordered_json stats_of(const Plan& plan, const Target& image, const Work& work) {
    const simd::EngineCounters& counters = work.counters;
    return {{"version", RAYLANE_VERSION},
            {"scene", printable(*plan.arguments.scene, 4096)},
            {"engine", plan.arguments.engine.text()},
            {"isa", isa_in_use(plan.options)},
            {"precision", core::name_of(plan.options.precision)},
            {"threads", plan.options.threads},
            {"ranks", plan.job.size()},
            {"width", image.settings.width},
            {"height", image.settings.height},
            {"quality", as_printed(image.settings.quality)},
            {"samples_per_pixel", work.samples_per_pixel},
            {"max_depth", image.settings.max_depth},
            {"min_weight", as_printed(image.settings.min_weight)},
            {"scene_fingerprint", image.fingerprint},
            {"options_fingerprint", fingerprint_of_options(image.settings, plan.options)},
            {"pixels_fingerprint", work.pixels_fingerprint},
            {"shapes", image.scene.shape_count()},
            {"scene_bytes", image.scene.bytes()},
            {"seconds", {{"load", work.load}, {"render", work.render}, {"write", work.write}}},
            {"rays",
             {{"primary", counters.primary},
              {"reflected", counters.reflected},
              {"refracted", counters.refracted},
              {"passed", counters.passed},
              {"shadow", counters.shadow},
              {"total", counters.rays()}}},
            {"rays_per_second", work.rays_per_second()},
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
            {"left_to_the_reference", {{"rays", counters.doubtful}, {"paths", counters.followed}}},
            {"legend", plan.annotator.stats()}};
}

void print(const Plan& plan, const Target& image, const core::Region& part, const Work& work) {
    const simd::RenderOptions& options = plan.options;
    if (plan.verbosity == Verbosity::verbose)
        std::fprintf(stderr, "%s engine, %s, %s precision, %d threads\n",
                     plan.arguments.engine.text().c_str(), std::string(isa_in_use(options)).c_str(),
                     plan.arguments.precision.text().c_str(), options.threads);
    if (plan.verbosity == Verbosity::verbose ||
        (plan.verbosity == Verbosity::normal && is_terminal()))
        std::fprintf(stderr, "%s: %d x %d pixels, %.8g samples each, in %s, %srays/s\n",
                     printable(image.name, 4096).c_str(), part.x1 - part.x0, part.y1 - part.y0,
                     std::round(100.0 * work.samples_per_pixel) / 100.0,
                     duration_text(work.render).c_str(),
                     with_prefix(work.rays_per_second()).c_str());
}

void render_single(Plan& plan) {
    Work work;
    auto start = std::chrono::steady_clock::now();
    const auto lap = [&start] {
        const auto before = std::exchange(start, std::chrono::steady_clock::now());
        return std::chrono::duration<double>(start - before).count();
    };
    Outputs outputs;
    open_outputs(outputs, plan);
    const core::Scene scene = load(plan, outputs);
    std::optional<Target> loaded;
    plan.job.together([&] {
        loaded.emplace(target_of(plan, scene, plan.output,
                                 plan.is_frame() ? std::optional<std::size_t>(0) : std::nullopt));
    });
    const Target& image = *loaded;
    plan.job.require_same(image.fingerprint + comment_of(plan, image), "the scene");
    const core::Region part = part_of(plan, image);
    if (plan.job.is_first()) {
        plan.annotator.compose(scene, image.settings, remarks_of(plan));
        plan.annotator.write_file(plan.number);
    }
    if (outputs.image) outputs.image->reserve(part.x1 - part.x0, part.y1 - part.y0);
    work.load = lap();

    simd::Progress progress;
    ResumableRendering drawing = resumable(plan, image);
    const simd::Rendering rendering = [&] {
        const ProgressBar bar(plan.verbosity, progress,
                              simd::drawn_part(image.settings, plan.options.crop).pixels());
        return drawing.draw(progress, &plan.job);
    }();
    if (!plan.job.is_first()) return;
    work.render = lap();
    work.pixels_fingerprint = write(plan, image, drawing, rendering, *outputs.image);
    work.write = lap();

    work.counters = rendering.counters;
    work.rays_now = progress.rays;
    // A part may have no pixels.
    work.samples_per_pixel = static_cast<double>(rendering.counters.primary) /
                             static_cast<double>(std::max<std::int64_t>(1, drawing.pixels()));
    if (outputs.stats) {
        outputs.stats->write(stats_of(plan, image, work).dump(2) + "\n");
        outputs.stats->commit();
    }
    drawing.end_if_signalled();
    print(plan, image, part, work);
}

int render(const RenderArguments& arguments) {
    Plan plan(arguments);
    if (plan.sequence)
        render_sequence(plan);
    else
        render_single(plan);
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
