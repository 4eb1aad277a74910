#include "scenes/annotation/annotations.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/files/words.hpp"
#include "scenes/formats/structure/drawing_options.hpp"
#include "scenes/formats/structure/lines.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace raylane::scenes {

namespace {

/// Returns the texts on both sides of a colon. Throws BadInput.
std::pair<std::string, std::string> two_parts(const std::string& option, const std::string& text,
                                              const char* must) {
    // A colon with a blank separates, as ranges such as 20:30 may come before it.
    const std::size_t colon = text.find(": ");
    if (colon != std::string::npos) {
        std::pair<std::string, std::string> parts = {
            std::string(trimmed(std::string_view(text).substr(0, colon))),
            std::string(trimmed(std::string_view(text).substr(colon + 1)))};
        if (!parts.first.empty() && !parts.second.empty()) return parts;
    }
    refuse(option, must, text);
}

using Setter = std::function<void(Annotations&, const std::string&, const std::string&)>;

/// Returns a setter that adds the words that `parse` reads to a list. `is_numbered`: messages name
/// the option with the number of the words.
template <class Words>
Setter adder_to(std::vector<Words> Annotations::*list,
                Words (*parse)(const std::string& option, const std::string& text),
                bool is_numbered) {
    return [=](Annotations& annotations, const std::string& option, const std::string& text) {
        std::vector<Words>& words = annotations.*list;
        words.push_back(
            parse(is_numbered ? option + "/" + std::to_string(words.size()) : option, text));
    };
}

const std::vector<std::pair<std::string_view, Setter>>& setters() {
    static const std::vector<std::pair<std::string_view, Setter>> known_setters = {
        {"legend",
         [](Annotations& a, const std::string& option, const std::string& text) {
             if (!on_or_off_of(option, text)) return;
             a.legend = true;
             a.is_legend_implied = false;
         }},
        {"legend-title",
         [](Annotations& a, const std::string&, const std::string& text) {
             if (!a.legend) a.is_legend_implied = true;
             a.legend = true;
             a.legend_title = text;
         }},
        {"scale-bar",
         [](Annotations& a, const std::string& option, const std::string& text) {
             if (text != "off") a.scale_bar = text == "on" ? 0.0 : bar_length_of(option, text);
         }},
        {"triad",
         [](Annotations& a, const std::string& option, const std::string& text) {
             if (text != "off")
                 a.axes = choice_named(option, text == "on" ? "auto" : text, named_axes());
         }},
        {"label", adder_to(&Annotations::labels, label_words_of, false)},
        {"labels", adder_to(&Annotations::labels, label_words_of, true)},
        {"distance", adder_to(&Annotations::distances, distance_words_of, false)},
        {"distances", adder_to(&Annotations::distances, distance_words_of, true)},
        {"font",
         [](Annotations& a, const std::string&, const std::string& text) { a.font = text; }},
        {"font-size",
         [](Annotations& a, const std::string& option, const std::string& text) {
             const float size = to_float(text).value_or(0.0F);
             if (!(size >= 1.0F && size <= 1000.0F))
                 refuse(option, "a number of points from 1 to 1000", text);
             a.font_size = pixels_of_points(static_cast<double>(size), 0.0);
         }},
    };
    return known_setters;
}

} // namespace

std::string Annotations::option(std::string_view name) const {
    if (has_dashes) return "--" + std::string(name);
    std::string result(name);
    std::replace(result.begin(), result.end(), '-', '_');
    return result;
}

std::vector<std::pair<std::string_view, Axes>> named_axes() {
    return {{"xyz", Axes::of_space}, {"abc", Axes::of_cell}, {"auto", Axes::automatic}};
}

double pixels_of_points(double size, double dpi) {
    constexpr double usual_dpi = 300.0, points_per_inch = 72.0;
    return size * (dpi > 0.0 ? dpi : usual_dpi) / points_per_inch;
}

double usual_font_size(int height) {
    constexpr double least = 10.0, share = 1.0 / 32.0, most_share = 0.2;
    return std::min(std::max(share * height, least), most_share * height);
}

LabelWords label_words_of(const std::string& option, const std::string& text) {
    auto [select, words] =
        two_parts(option, text, "SELECTION: TEXT, such as \"residue 25: Asp 25\"");
    const std::vector<std::string_view> fields = {"{element}", "{name}",  "{resn}",
                                                  "{resi}",    "{chain}", "{index}"};
    for (std::size_t at = words.find('{'); at != std::string::npos; at = words.find('{', at + 1)) {
        const std::size_t end = words.find('}', at);
        if (end == std::string::npos)
            throw BadInput(option, "",
                           "must have a } behind each {, got \"" + printable(words.substr(at)) +
                               '"');
        const std::string field = words.substr(at, end + 1 - at);
        if (std::find(fields.begin(), fields.end(), field) == fields.end())
            throw BadInput(option, "",
                           "must have fields such as {element} or {index}, got \"" +
                               printable(field) + '"' + suggestion(field, fields));
    }
    return {std::move(select), std::move(words), option};
}

DistanceWords distance_words_of(const std::string& option, const std::string& text) {
    auto [from, to] = two_parts(option, text, "SELECTION: SELECTION, such as \"index 1: index 5\"");
    return {std::move(from), std::move(to), option};
}

double bar_length_of(const std::string& option, const std::string& text) {
    if (text == "auto") return 0.0;
    const float length = to_float(text).value_or(0.0F);
    if (!(length > 0.0F)) refuse(option, "auto or a length above 0", text);
    return static_cast<double>(length);
}

bool set_option(Annotations& annotations, const std::string& name, const std::string& text) {
    std::string dashed = name.substr(name.starts_with("--") ? 2 : 0);
    std::replace(dashed.begin(), dashed.end(), '_', '-');
    for (const auto& [known, set] : setters())
        if (known == dashed) {
            set(annotations, name, text);
            return true;
        }
    return false;
}

} // namespace raylane::scenes
