#include "scenes/tool/picture_arguments.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/image/exr.hpp"
#include "scenes/library/raylane/version.h"
#include "scenes/tool/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>

namespace raylane::scenes {

namespace {

constexpr const char* pictures_group = "Images";

/// Parses X,Y,WxH.
core::Region crop_argument(const std::string& text) {
    std::optional<int> numbers[4];
    std::string_view rest = text;
    for (int i = 0; i < 4; ++i) {
        const std::size_t end = i < 3 ? rest.find(i == 2 ? 'x' : ',') : rest.size();
        if (end == std::string_view::npos) break;
        numbers[i] = to_int(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    const auto is_within = [](const std::optional<int>& number, int least) {
        return number && *number >= least && *number <= core::Settings::max_size;
    };
    if (!is_within(numbers[0], 0) || !is_within(numbers[1], 0) || !is_within(numbers[2], 1) ||
        !is_within(numbers[3], 1))
        throw BadInput("--crop", "",
                       "must be X,Y,WIDTHxHEIGHT in pixels from the upper left corner, such as "
                       "100,50,320x240, got \"" +
                           printable(text) + "\"");
    return {*numbers[0], *numbers[1], *numbers[0] + *numbers[2], *numbers[1] + *numbers[3]};
}

core::Color color_argument(const std::string& option, const std::string& text) {
    std::uint32_t code = 0;
    const char* const end = text.data() + text.size();
    if (text.size() != 7 || text[0] != '#' ||
        std::from_chars(text.data() + 1, end, code, 16).ptr != end)
        throw BadInput(option, "",
                       "must be #rrggbb, such as #204060, got \"" + printable(text) + "\"");
    const auto channel = [&](int shift) {
        return core::decode_srgb(static_cast<std::uint8_t>(code >> shift & 0xFF));
    };
    return {channel(16), channel(8), channel(0)};
}

std::string text_of(const core::Region& crop) {
    return std::to_string(crop.x0) + "," + std::to_string(crop.y0) + "," +
           std::to_string(crop.x1 - crop.x0) + "x" + std::to_string(crop.y1 - crop.y0);
}

/// Returns a colour as #rrggbb.
std::string text_of(const core::Color& color) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", core::encode(color.x, core::Transfer::srgb),
                  core::encode(color.y, core::Transfer::srgb),
                  core::encode(color.z, core::Transfer::srgb));
    return text;
}

/// Returns options of the tool that reproduce the settings for a scene whose settings are `own`.
std::string text_of(const core::Settings& settings, const core::Settings& own, bool names_size) {
    static constexpr const char* filters[] = {"box", "gaussian", "blackman-harris"};
    std::string text;
    if (names_size)
        text = "--size " + std::to_string(settings.width) + "x" + std::to_string(settings.height) +
               " ";
    text += settings.quality != 0.0F ? "--quality " + to_text(settings.quality)
                                     : "--spp " + std::to_string(settings.grid * settings.grid);
    text += " --filter " + std::string(filters[static_cast<int>(settings.filter)]);
    if (settings.light_samples != 0)
        text += " --light-samples " + std::to_string(settings.light_samples);
    text += " --max-depth " + std::to_string(settings.max_depth);
    if (std::min(settings.max_see_through, own.max_see_through) < core::Settings::see_through_limit)
        text += " --max-see-through " + std::to_string(settings.max_see_through);
    text += " --min-weight " + to_text(settings.min_weight);
    if (settings.transfer != core::Transfer::srgb || own.transfer != core::Transfer::srgb)
        text +=
            settings.transfer == core::Transfer::srgb ? " --transfer srgb" : " --transfer linear";
    const core::Outline &outline = settings.outline, &own_outline = own.outline;
    if (outline.any() || own_outline.any()) text += " --outline " + to_text(outline.width);
    // Only if it differs, because a scene's colour may lie between two codes.
    if (outline.any() && outline.color != own_outline.color)
        text += " --outline-color " + text_of(outline.color);
    if (outline.any() && outline.creases != own_outline.creases)
        text += " --outline-creases " + to_text(outline.creases);
    return text;
}

} // namespace

void PictureArguments::add_to(CLI::App& command) {
    const auto add = [&](const char* name, Argument& value, const char* help, const char* type) {
        add_option(command, name, value, help, type)->group(pictures_group);
    };
    add("--crop", crop,
        "Render only this rectangle: its upper left corner and its size, in pixels of the whole "
        "image.",
        "X,Y,WxH");
    add("--bits", bits,
        "Bits per channel: 8 or 16 (PNG), 16 (half) or 32 (float) (EXR). Default: 8 (PNG), 16 "
        "(EXR).",
        "N");
    add("--dpi", dpi, "Print resolution stored in PNG or EXR, in pixels per inch. Default: none.",
        "N");
    add_flag(
        command, "--layers", layers,
        "Add AOVs of the first surface at the middle of each pixel to an EXR: Z (distance along "
        "the ray), N.X, N.Y, N.Z, id.shape, id.material and samples (number of samples).");
    command.get_option("--layers")->group(pictures_group);
    add_flag(command, "--alpha", alpha,
             "Omit the background, for compositing. The alpha of a PNG or EXR is the covered share "
             "of each pixel.");
    command.get_option("--alpha")->group(pictures_group);
    add("--outline", outline,
        "Draw outlines where one surface hides another: their width in pixels, 0 for none. "
        "Default: as in the scene.",
        "WIDTH");
    add("--outline-color", outline_color,
        "Colour of the outlines. Default: as in the scene, otherwise #000000.", "#RRGGBB");
    add("--outline-creases", outline_creases,
        "Draw outlines also between materials and where surfaces bend by more than DEGREES; 180 "
        "for none of these. Default: as in the scene, otherwise 180.",
        "DEGREES");
}

PictureChoice::PictureChoice(const PictureArguments& arguments)
    : layers(arguments.layers), alpha(arguments.alpha) {
    if (arguments.crop) crop = crop_argument(*arguments.crop);
    if (arguments.bits)
        bits = choice_argument<int>("--bits", *arguments.bits, {{"8", 8}, {"16", 16}, {"32", 32}});
    if (arguments.dpi) dpi = number_argument("--dpi", *arguments.dpi, 1.0F, 10000.0F);
    if (arguments.outline)
        outline = number_argument("--outline", *arguments.outline, 0.0F, core::Outline::max_width);
    if (arguments.outline_color)
        outline_color = color_argument("--outline-color", *arguments.outline_color);
    if (arguments.outline_creases)
        outline_creases =
            number_argument("--outline-creases", *arguments.outline_creases, 0.0F, 180.0F);
}

void PictureChoice::require_fit(PictureFormat format) const {
    const bool is_png = format == PictureFormat::png, is_exr = format == PictureFormat::exr;
    require_writable("--output", format);
    if (layers && !is_exr) throw BadInput("--layers", "", "goes with an output that ends in .exr");
    if (alpha && !is_png && !is_exr) throw BadInput("--alpha", "", "goes with PNG or EXR");
    if (dpi && !is_png && !is_exr) throw BadInput("--dpi", "", "goes with PNG or EXR");
    if (bits != 0 && !is_png && !is_exr) throw BadInput("--bits", "", "goes with PNG or EXR");
    if (bits == 32 && is_png) throw BadInput("--bits", "", "must be 8 or 16 in PNG, got \"32\"");
    if (bits == 8 && is_exr) throw BadInput("--bits", "", "must be 16 or 32 in EXR, got \"8\"");
}

void require_writable(const std::string& option, PictureFormat format) {
    if (format == PictureFormat::exr && !has_exr())
        throw BadInput(option, "",
                       "must be .png, .hdr or .pfm: raylane was built without libopenexr-dev");
}

void PictureChoice::apply_to(core::Settings& settings) const {
    settings.alpha = settings.alpha || alpha;
    settings.outline.width = outline.value_or(settings.outline.width);
    settings.outline.color = outline_color.value_or(settings.outline.color);
    settings.outline.creases = outline_creases.value_or(settings.outline.creases);
    if (settings.outline.any() || outline) return;
    if (outline_color) throw BadInput("--outline-color", "", "goes with --outline");
    if (outline_creases) throw BadInput("--outline-creases", "", "goes with --outline");
}

void PictureChoice::apply_to(simd::RenderOptions& options, const core::Settings& settings) const {
    if (crop && (crop->x1 > settings.width || crop->y1 > settings.height))
        throw BadInput("--crop", "",
                       "must lie in the image of " + std::to_string(settings.width) + " x " +
                           std::to_string(settings.height) + " pixels, got \"" + text_of(*crop) +
                           "\"");
    options.crop = crop;
    options.layers = layers;
}

PictureOptions PictureChoice::options(const std::string& scene, const core::Settings& settings,
                                      const core::Settings& own, const std::string& others,
                                      bool names_size) const {
    PictureOptions options{settings.transfer, bits, dpi, {}};
    if (scene != "-")
        options.texts.emplace_back(
            "Title", printable(std::filesystem::path(scene).filename().string(), 4096));
    options.texts.emplace_back("Software", "raylane " RAYLANE_VERSION);
    options.texts.emplace_back("Comment", text(settings, own, names_size) + others);
    return options;
}

std::string PictureChoice::text(const core::Settings& settings, const core::Settings& own,
                                bool names_size) const {
    return text_of(settings, own, names_size) + (alpha ? " --alpha" : "") +
           (crop ? " --crop " + text_of(*crop) : "");
}

} // namespace raylane::scenes
