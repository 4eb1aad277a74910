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
                       "this program was built without " + text + ", with " + available);
    if (!simd::is_available(isa))
        throw BadInput("--isa", "", "this processor has no " + text + ", but " + available);
    return isa;
}

} // namespace

void RenderArguments::add_to(CLI::App& command) {
    const auto add = [&](const char* names, Argument& value, const char* help, const char* type) {
        add_option(command, names, value, help, type);
    };
    add_positional(command, "SCENE", scene,
                   "A scene in JSON, NFF, POV-Ray's language or Tachyon's, or that build wrote, or "
                   "atoms in PDB, mmCIF, CIF, XYZ, "
                   "GRO or LAMMPS' formats, compressed by gzip or not; - is standard input");
    add("-o,--output", output,
        "The picture: .png, .exr, .hdr, .pfm, .tga, .bmp or .ppm, or - for a PNG to standard "
        "output "
        "(default: the scene's name, .png)",
        "FILE");
    add("--size", size, "Pixels (default: as the scene says)", "WxH");
    add("--spp", samples, "Samples per pixel, a square number (default: as the scene says)", "N");
    add("--quality", quality,
        "Decibels (PSNR) that the picture is to have against a converged one, 10 to 80, instead of "
        "--spp; 40 is good print (default: as the scene says)",
        "DB");
    add("--filter", filter,
        "What of its surroundings a pixel shows: box (its own square), gaussian or "
        "blackman-harris, which reach 1.5 pixels far and are smoother (default: as the scene says)",
        "box|gaussian|blackman-harris");
    add("--light-samples", light_samples,
        "Rays to each light with a size, from each point that a sample sees (default: as the scene "
        "says, or four if pixels have one sample, one otherwise); -1: hard light, which is one ray "
        "to the middle of each lamp, and a sky that nothing shades",
        "N");
    add_flag(command, "--draft", draft, "For a quick look: --spp 1 --light-samples -1");
    add_flag(command, "--print", print, "For print, without grain at 300 dpi: --quality 50");
    add("--max-depth", max_depth,
        "Reflections and refractions one after the other (default: as the scene says)", "N");
    add("--max-see-through", max_see_through,
        "See-through surfaces that are shown one behind the other; further ones are left out "
        "(default: as the scene says, or all)",
        "N");
    add("--min-weight", min_weight,
        "Leave paths of less influence on the pixel (default: as the scene says)", "W");
    add("--threads", threads, "Threads (default: all processors)", "N");
    add("--engine", engine,
        "What traces: vector, or reference, which is slow and written to be read (default: vector)",
        "vector|reference");
    add("--isa", isa, "The vector engine's instructions (default: the best there are)",
        "portable|sse4.2|avx2|avx512|neon");
    add("--tile", tile,
        "Pixels on the side of the squares that threads work on, 8 to 64; changes no exact picture",
        "N");
    add("--precision", precision,
        "What decides where rays hit: fast (textbook formulas in float), robust (the best in "
        "float), exact (certified, as real numbers would have it) or double (robust's "
        "formulas in double) (default: exact)",
        "fast|robust|exact|double");
    add("--transfer", transfer, "From light to PNG (default: as the scene says)", "srgb|linear");
    add("--stats", stats, "Write figures about the rendering as JSON; - is standard output",
        "FILE");
    add_flag(command, "--no-resume", no_resume,
             "Do not go on with what an earlier rendering has left in FILE.part when it was ended, "
             "and leave nothing to go on with");
    add("--part", part,
        "Draw this part of the picture's tiles alone, for N processes or machines to draw one "
        "each, into an EXR that merge puts together with the others; of several pictures every "
        "N-th, "
        "from the K-th on",
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
