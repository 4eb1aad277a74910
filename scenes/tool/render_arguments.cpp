#include "scenes/tool/render_arguments.hpp"

#include "scenes/errors.hpp"
#include "scenes/tool/arguments.hpp"

#include <string_view>
#include <tuple>
#include <vector>

namespace raylane::scenes {

namespace {

simd::Isa isa_argument(const std::string& text, simd::Engine engine) {
    std::vector<std::pair<std::string_view, simd::Isa>> choices;
    simd::narrowest_isa(); // throws if this processor supports no ISA that was built
    std::string available;
    for (const simd::Isa isa : simd::all_isas) {
        choices.emplace_back(simd::name_of(isa), isa);
        if (simd::is_available(isa))
            available += (available.empty() ? "" : ", ") + std::string(simd::name_of(isa));
    }
    const auto isa = choice_argument<simd::Isa>("--isa", text, choices);
    if (engine != simd::Engine::vector) throw BadInput("--isa", "", "goes with --engine vector");
    if (!simd::is_built(isa))
        throw BadInput("--isa", "",
                       "raylane was built without " + text + "; available: " + available);
    if (!simd::is_available(isa))
        throw BadInput("--isa", "",
                       "this processor does not support " + text + "; available: " + available);
    return isa;
}

} // namespace

void RenderArguments::add_to(CLI::App& command) {
    const auto add = [&](const char* names, Argument& value, const char* help, const char* type) {
        add_option(command, names, value, help, type);
    };
    add_positional(command, "SCENE", scene,
                   "Scene (JSON, NFF, POV-Ray, Tachyon, or .rl from build) or atoms (PDB, mmCIF, "
                   "CIF, XYZ, GRO, LAMMPS), optionally gzipped; - is standard input.");
    add("-o,--output", output,
        "Image, .png, .exr, .hdr, .pfm, .tga, .bmp or .ppm; - writes a PNG to standard output. "
        "Default: the scene's name with .png, in the current folder.",
        "FILE");
    add("--size", size, "Image width and height in pixels. Default: as in the scene.", "WxH");
    add("--spp", samples, "Samples per pixel, a square number. Default: as in the scene.", "N");
    add("--quality", quality,
        "Target PSNR against a converged image, 10 to 80 dB, instead of --spp; 40 suits print. "
        "Default: as in the scene.",
        "DB");
    add("--filter", filter,
        "Pixel filter: box (the square of the pixel), or the smoother gaussian or blackman-harris "
        "(radius 1.5 pixels). Default: as in the scene.",
        "box|gaussian|blackman-harris");
    add("--light-samples", light_samples,
        "Shadow rays to each area or sky light, from each shaded point. -1: hard shadows, with one "
        "ray to the centre of each light, and an unshadowed sky. Default: as in the scene, "
        "otherwise 4 with one sample per pixel, 1 with more.",
        "N");
    add_flag(command, "--draft", draft, "Fast preview, same as --spp 1 --light-samples -1.");
    add_flag(command, "--print", print,
             "Print quality, without grain at 300 dpi, same as --quality 50.");
    add("--max-depth", max_depth,
        "Maximum number of reflections and refractions along a path. Default: as in the scene.",
        "N");
    add("--max-see-through", max_see_through,
        "Maximum number of transparent surfaces shown one behind the other; further ones are "
        "omitted. Default: as in the scene, otherwise all.",
        "N");
    add("--min-weight", min_weight,
        "Minimum weight of a path in its pixel, 0 to 1; paths below it end. Default: as in the "
        "scene.",
        "W");
    add("--threads", threads, "Number of threads. Default: all processors.", "N");
    add("--engine", engine,
        "Engine: vector, or reference, which is scalar and slow. Default: vector.",
        "vector|reference");
    add("--isa", isa, "Instruction set of the vector engine. Default: the widest available one.",
        "portable|sse4.2|avx2|avx512|neon");
    add("--tile", tile,
        "Side of the tiles that threads render, 8 to 64 pixels. Images of precision exact do not "
        "depend on it.",
        "N");
    add("--precision", precision,
        "Arithmetic of intersections: fast (textbook formulas in float), robust (best formulas in "
        "float), exact (certified, with the results of real arithmetic) or double (formulas of "
        "robust in double). Default: exact.",
        "fast|robust|exact|double");
    add("--transfer", transfer,
        "Transfer function of 8-bit and 16-bit images. Default: as in the scene.", "srgb|linear");
    add("--stats", stats, "Write statistics of the render as JSON; - is standard output.", "FILE");
    add_flag(command, "--no-resume", no_resume,
             "Ignore checkpoints of interrupted renders (FILE.part), and write none.");
    add("--part", part,
        "Render part K of N, for N processes or machines: some tiles of an image, in an EXR for "
        "merge; of a sequence, every N-th image from the K-th on.",
        "K/N");
    picture.add_to(command);
    frames.add_to(command);
    scene_arguments.add_to(command, true);
}

Overrides::Overrides(const RenderArguments& arguments) {
    using core::Settings;
    if (arguments.size) size = size_argument("--size", *arguments.size);
    if (arguments.samples) grid = square_argument("--spp", *arguments.samples, Settings::max_grid);
    if (arguments.quality) quality = number_argument("--quality", *arguments.quality, 10.0F, 80.0F);
    if (quality && grid) throw BadInput("--quality", "", "goes without --spp");
    if (arguments.draft || arguments.print) {
        const char* const name = arguments.draft ? "--draft" : "--print";
        if (arguments.draft && arguments.print) throw BadInput(name, "", "goes without --print");
        for (const auto& [other, is_given] :
             {std::pair{"--spp", grid.has_value()},
              {"--quality", quality.has_value()},
              {"--light-samples", arguments.light_samples && arguments.draft}})
            if (is_given) throw BadInput(name, "", std::string("goes without ") + other);
        if (arguments.draft) {
            grid = 1;
            light_samples = Settings::hard_light;
        } else {
            quality = 50.0F;
        }
    }
    if (arguments.filter)
        filter = choice_argument<core::PixelFilter>(
            "--filter", *arguments.filter,
            {{"box", core::PixelFilter::box},
             {"gaussian", core::PixelFilter::gaussian},
             {"blackman-harris", core::PixelFilter::blackman_harris}});
    if (arguments.light_samples)
        light_samples = whole_argument("--light-samples", *arguments.light_samples,
                                       Settings::hard_light, Settings::max_light_samples);
    if (arguments.max_depth)
        max_depth = whole_argument("--max-depth", *arguments.max_depth, 0, Settings::depth_limit);
    if (arguments.max_see_through)
        max_see_through = whole_argument("--max-see-through", *arguments.max_see_through, 1,
                                         Settings::see_through_limit);
    if (arguments.min_weight)
        min_weight = number_argument("--min-weight", *arguments.min_weight, 0.0F, 1.0F);
    if (arguments.transfer)
        transfer = choice_argument<core::Transfer>(
            "--transfer", *arguments.transfer,
            {{"srgb", core::Transfer::srgb}, {"linear", core::Transfer::linear}});
}

core::Settings Overrides::applied_to(core::Settings settings) const {
    if (size) std::tie(settings.width, settings.height) = *size;
    settings.grid = grid.value_or(settings.grid);
    settings.filter = filter.value_or(settings.filter);
    settings.light_samples = light_samples.value_or(settings.light_samples);
    settings.quality = quality.value_or(grid ? 0.0F : settings.quality);
    settings.max_depth = max_depth.value_or(settings.max_depth);
    settings.max_see_through = max_see_through.value_or(settings.max_see_through);
    settings.min_weight = min_weight.value_or(settings.min_weight);
    settings.transfer = transfer.value_or(settings.transfer);
    return settings;
}

core::Precision precision_argument(const std::string& text) {
    std::vector<std::pair<std::string_view, core::Precision>> choices;
    for (const core::Precision precision : core::all_precisions)
        choices.emplace_back(core::name_of(precision), precision);
    return choice_argument<core::Precision>("--precision", text, choices);
}

std::optional<PicturePart> part_argument(const Argument& text) {
    if (!text) return std::nullopt;
    const std::optional<PicturePart> part = picture_part_of(*text);
    if (!part)
        throw BadInput("--part", "",
                       "must be K/N, from 1/N to N/N, such as 3/16, got \"" + printable(*text) +
                           "\"");
    return part;
}

simd::RenderOptions options_of(const RenderArguments& arguments) {
    simd::RenderOptions options;
    options.engine = choice_argument<simd::Engine>(
        "--engine", *arguments.engine,
        {{"vector", simd::Engine::vector}, {"reference", simd::Engine::reference}});
    if (arguments.isa) options.isa = isa_argument(*arguments.isa, options.engine);
    if (arguments.tile) options.tile = whole_argument("--tile", *arguments.tile, 8, 64);
    options.threads = threads_argument(arguments.threads);
    return options;
}

} // namespace raylane::scenes
