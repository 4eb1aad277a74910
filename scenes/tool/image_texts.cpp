#include "scenes/tool/image_texts.hpp"

#include "scenes/export/writers.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/tool/checkpoint/fingerprint.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <string_view>

namespace raylane::scenes {

bool has_text(const ImageTexts& texts, const std::string& name) {
    return std::any_of(texts.begin(), texts.end(), [&](const auto& t) { return t.first == name; });
}

const std::string& text_in(const std::string& image, const ImageTexts& texts,
                           const std::string& name) {
    for (const auto& [key, text] : texts)
        if (key == name) return text;
    throw BadInput(
        image, "",
        "must be a PNG, TIFF or EXR rendered by raylane, which names its scene and options, "
        "got one without " +
            name);
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

std::string ImagePart::text() const {
    return std::to_string(number) + "/" + std::to_string(count);
}

std::optional<ImagePart> image_part_of(const std::string& text) {
    constexpr int most = 1'000'000;
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) return std::nullopt;
    const std::string_view original = text;
    const std::optional<int> number = to_int(original.substr(0, slash));
    const std::optional<int> count = to_int(original.substr(slash + 1));
    if (!number || !count || *number < 1 || *number > *count || *count > most) return std::nullopt;
    return ImagePart{static_cast<std::size_t>(*number), static_cast<std::size_t>(*count)};
}

RayTiers::RayTiers(const simd::EngineCounters& counters)
    : first(counters.rays() - std::min(counters.rays(), counters.refined + counters.doubtful)),
      second(counters.refined), reference(counters.doubtful + counters.followed),
      widened(counters.widened) {}

RayTiers& RayTiers::operator+=(const RayTiers& other) {
    first += other.first;
    second += other.second;
    reference += other.reference;
    widened += other.widened;
    return *this;
}

std::string RayTiers::text() const {
    return std::to_string(first) + " at first sight, " + std::to_string(second) + " at second, " +
           std::to_string(reference) + " by the reference, " + std::to_string(widened) +
           " tests beyond double";
}

std::optional<RayTiers> ray_tiers_of(const std::string& text) {
    RayTiers tiers;
    const int found = std::sscanf(text.c_str(),
                                  "%" SCNu64 " at first sight, %" SCNu64 " at second, %" SCNu64
                                  " by the reference, %" SCNu64,
                                  &tiers.first, &tiers.second, &tiers.reference, &tiers.widened);
    if (found != 4 || tiers.text() != text) return std::nullopt;
    return tiers;
}

} // namespace raylane::scenes
