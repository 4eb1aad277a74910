#include "scenes/tool/picture_texts.hpp"

#include "scenes/errors.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/tool/journal/fingerprint.hpp"

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace raylane::scenes {

bool has_text(const PictureTexts& texts, const std::string& name) {
    return std::any_of(texts.begin(), texts.end(), [&](const auto& t) { return t.first == name; });
}

const std::string& text_in(const std::string& picture, const PictureTexts& texts,
                           const std::string& name) {
    for (const auto& [key, text] : texts)
        if (key == name) return text;
    throw BadInput(picture, "",
                   "must be a PNG or EXR rendered by raylane, which names its scene and options, "
                   "got one without " +
                       name);
}

RenderArguments arguments_of(const std::string& picture, const PictureTexts& texts,
                             const std::string& scene) {
    RenderArguments arguments;
    if (!take_options(text_in(picture, texts, "Comment"),
                      [&](CLI::App& command) { arguments.add_to(command); }) ||
        arguments.scene)
        throw BadInput(picture, "", "has a Comment that is not a list of options of render");
    arguments.scene = scene;
    return arguments;
}

std::string options_line(core::Settings settings, const simd::RenderOptions& options) {
    // These settings have no effect here.
    if (settings.quality != 0.0F) settings.grid = core::Settings{}.grid;
    if (!settings.outline.any()) settings.outline = {};
    std::string line;
    TextFile settings_text([&](std::string_view piece) { line += piece; });
    write_json_settings(settings_text, settings);
    settings_text.flush();
    const bool is_vector = options.engine == simd::Engine::vector;
    line += is_vector ? " vector" : " reference";
    line += " --precision " + std::string(core::name_of(options.precision));
    if (const std::optional<core::Region>& crop = options.crop)
        for (const int edge : {crop->x0, crop->y0, crop->x1, crop->y1})
            line += " " + std::to_string(edge);
    if (options.precision == core::Precision::exact) return line;
    line += " --tile " + std::to_string(simd::tile_of(settings, options));
    if (is_vector) line += " --isa " + std::string(simd::name_of(options.isa));
    return line;
}

std::string fingerprint_of_options(const core::Settings& settings,
                                   const simd::RenderOptions& options) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx",
                  static_cast<unsigned long long>(checksum_of(options_line(settings, options), 0)));
    return digits;
}

} // namespace raylane::scenes
