#include "scenes/tool/options/render_options.hpp"

#include "core/scene/transfer.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/structure/drawing_options.hpp"
#include "scenes/images/exr.hpp"
#include "scenes/tool/options/command_line.hpp"

#include <cstdio>
#include <optional>
#include <tuple>

namespace raylane::scenes {

namespace {

/// Returns a colour as #rrggbb.
std::string text_of(const core::Color& color) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", core::encode(color.x, core::Transfer::srgb),
                  core::encode(color.y, core::Transfer::srgb),
                  core::encode(color.z, core::Transfer::srgb));
    return text;
}

/// Throws BadInput unless this processor supports the instruction set.
void require_available(simd::Isa isa) {
    if (simd::is_available(isa)) return;
    std::string available;
    for (const simd::Isa other : simd::all_isas)
        if (simd::is_available(other))
            available += (available.empty() ? "" : ", ") + std::string(simd::name_of(other));
    throw BadInput(
        "--isa", "",
        (simd::is_built(isa) ? "this processor does not support " : "raylane was built without ") +
            std::string(simd::name_of(isa)) + "; available: " + available);
}

} // namespace

Values<core::Region> crops() {
    const auto parse = [](const std::string& option, const std::string& text) {
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
            refuse(option,
                   "X,Y,WIDTHxHEIGHT in pixels from the upper left corner, such as "
                   "100,50,320x240",
                   text);
        return core::Region{*numbers[0], *numbers[1], *numbers[0] + *numbers[2],
                            *numbers[1] + *numbers[3]};
    };
    return {"X,Y,WxH", "", parse};
}

Values<core::Color> colors() {
    const auto parse = [](const std::string& option, const std::string& text) {
        return named_color_of(option, text);
    };
    return {"COLOR", "", parse, [](const core::Color& color) { return text_of(color); }};
}

Values<double> bar_lengths() {
    return {"LENGTH", "", bar_length_of};
}

Values<LabelWords> label_texts() {
    return {"WHICH:TEXT", "", label_words_of};
}

Values<DistanceWords> distance_texts() {
    return {"A:B", "", distance_words_of};
}

Values<ImagePart> image_parts() {
    return {"K/N", "", [](const std::string& option, const std::string& text) {
                const std::optional<ImagePart> part = image_part_of(text);
                if (!part) refuse(option, "K/N, from 1/N to N/N, such as 3/16", text);
                return *part;
            }};
}

Values<simd::Isa> instruction_sets() {
    std::vector<std::pair<std::string_view, simd::Isa>> choices;
    for (const simd::Isa isa : simd::all_isas)
        choices.emplace_back(simd::name_of(isa), isa);
    return choice(choices);
}

void require_writable(const std::string& option, ImageFormat format) {
    if (format == ImageFormat::exr && !has_exr())
        throw BadInput(option, "",
                       "must be .png, .hdr or .pfm: raylane was built without libopenexr-dev");
    if (format == ImageFormat::tiff && !has_tiff())
        throw BadInput(option, "",
                       "must be .png, .hdr or .pfm: raylane was built without libtiff-dev");
}

void EncodingArguments::require_fit(ImageFormat format) const {
    const bool is_exr = format == ImageFormat::exr;
    const bool has_codes = format == ImageFormat::png || format == ImageFormat::tiff;
    for (const AnyOption* option : options())
        if (option->is_given() && !has_codes && !is_exr)
            throw BadInput(option->name(), "", "goes with PNG, TIFF or EXR");
    if (bits && *bits == 32 && has_codes) refuse("--bits", "8 or 16 in PNG and TIFF", "32");
    if (bits && *bits == 8 && is_exr) refuse("--bits", "16 or 32 in EXR", "8");
}

std::optional<float> EncodingArguments::dpi_for(const Option<ImageSize>& size) const {
    if (dpi || !size || !size->on_paper) return dpi.value();
    return usual_dpi;
}

void ImageArguments::require_fit(ImageFormat format) const {
    const bool is_exr = format == ImageFormat::exr;
    require_writable("--output", format);
    if (aovs && !is_exr) throw BadInput("--aovs", "", "goes with an output that ends in .exr");
    if (alpha && !stores_alpha(format)) throw BadInput("--alpha", "", "goes with PNG, TIFF or EXR");
    encoding.require_fit(format);
}

void ImageArguments::apply_to(simd::RenderOptions& options, const core::Settings& settings) const {
    if (crop && (crop->x1 > settings.width || crop->y1 > settings.height))
        throw BadInput("--crop", "",
                       "must lie in the image of " + std::to_string(settings.width) + " x " +
                           std::to_string(settings.height) + " pixels, got \"" +
                           crop.texts().front() + "\"");
    options.crop = crop.value();
    options.aovs = aovs.is_given();
}

RenderArguments::RenderArguments() = default;

core::Settings SettingArguments::settings_of(const core::Settings& own,
                                             const std::pair<int, int>& size,
                                             bool scales_outline) const {
    core::Settings settings = own;
    std::tie(settings.width, settings.height) = size;
    if (scales_outline)
        settings.outline.width = std::min(core::Outline::max_width,
                                          own.outline.width * static_cast<float>(settings.height) /
                                              static_cast<float>(own.height));
    apply_to(settings);
    if (samples || draft) settings.quality = 0.0F;
    if (draft) settings.grid = 1;
    if (draft) settings.light_samples = core::Settings::hard_light;
    if (print) settings.quality = 50.0F;
    if (settings.outline.any() || outline) return settings;
    for (const AnyOption* option : {static_cast<const AnyOption*>(&outline_color),
                                    static_cast<const AnyOption*>(&outline_creases)})
        if (option->is_given()) throw BadInput(option->name(), "", "goes with --outline");
    return settings;
}

core::Settings RenderArguments::settings_of(const core::Settings& own) const {
    std::pair<int, int> pixels = {own.width, own.height};
    if (size) pixels = size->in_pixels(double(dpi().value_or(0.0F)), pixels);
    core::Settings settings =
        setting.settings_of(own, pixels, scene_arguments.drawing.look.is_given());
    if (image.alpha || has_no_background()) settings.alpha = true;
    return settings;
}

bool RenderArguments::has_no_background() const {
    const Option<Background>& background = scene_arguments.view.background;
    return background && !background->color;
}

void RenderArguments::require_fit(ImageFormat format) const {
    image.require_fit(format);
    if (has_no_background() && !stores_alpha(format))
        throw BadInput("--background", "", "none goes with PNG, TIFF or EXR");
}

std::optional<float> RenderArguments::dpi() const {
    return image.encoding.dpi_for(size);
}

Annotations AnnotationArguments::annotations_at(std::optional<float> dpi,
                                                bool axes_on_right) const {
    const auto resolution = static_cast<double>(dpi.value_or(0.0F));
    Annotations result;
    result.legend = legend.is_given() || legend_title.is_given();
    result.is_legend_implied = !legend.is_given();
    result.legend_title = legend_title.value_or("");
    result.scale_bar = scale_bar.value();
    result.axes = axes.value();
    result.axes_on_right = axes_on_right;
    result.labels = *label;
    result.distances = *distance;
    result.font = font.value_or(result.font);
    if (font_size) result.font_size = pixels_of_points(static_cast<double>(*font_size), resolution);
    result.dpi = resolution;
    const std::string first = first_given();
    if (!result.any() && !first.empty())
        throw BadInput(first, "",
                       "goes with --legend, --scale-bar, --triad, --label or --distance");
    return result;
}

Annotations RenderArguments::annotations() const {
    Annotations result = annotation.annotations_at(dpi(), scene_arguments.drawing.axes.is_given());
    result.is_steady = has_sequence();
    return result;
}

bool RenderArguments::has_sequence() const {
    return !frames.is_one() &&
           (frames.frames || frames.turn || scene_arguments.parameters.has_sweep());
}

simd::RenderOptions RenderArguments::render_options(bool with_isa) const {
    simd::RenderOptions options;
    options.engine = *engine;
    options.precision = *precision;
    if (with_isa && isa) {
        simd::narrowest_isa(); // throws if this processor supports no ISA that was built
        if (*engine != simd::Engine::vector)
            throw BadInput("--isa", "", "goes with --engine vector");
        require_available(*isa);
        options.isa = *isa;
    }
    options.tile = tile.value_or(options.tile);
    options.threads = threads.count();
    return options;
}

std::unique_ptr<RenderArguments>
recorded_arguments(const std::string& image, const ImageTexts& texts, const std::string& scene) {
    auto arguments = std::make_unique<RenderArguments>();
    arguments->scene.give({scene});
    if (!take_recorded(text_in(image, texts, "Comment"), *arguments))
        throw BadInput(image, "", "has a Comment that is not a list of options of render");
    return arguments;
}

} // namespace raylane::scenes
