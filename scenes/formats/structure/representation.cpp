#include "scenes/formats/structure/representation.hpp"

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/formats/structure/cartoon/chain_colors.hpp"
#include "scenes/formats/structure/colors.hpp"
#include "scenes/formats/structure/elements.hpp"
#include "scenes/formats/structure/lines.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

constexpr float largest_size = 1e6F;

/// Returns the place of the last colon that is not within a range such as 20:30, or npos.
std::size_t separator_in(std::string_view text) {
    for (std::size_t i = text.rfind(':'); i != std::string_view::npos && i < text.size();
         i = i == 0 ? std::string_view::npos : text.rfind(':', i - 1)) {
        const bool is_range =
            i > 0 && i + 1 < text.size() && is_digit(text[i - 1]) && is_digit(text[i + 1]);
        if (!is_range) return i;
    }
    return std::string_view::npos;
}

/// The words of an option's value, separated by blanks or commas.
class WordList {
  public:
    WordList(const std::string& option, std::string_view text, std::size_t start)
        : option_(option), text_(text), position_(start) {
        advance();
    }

    bool at_end() const { return word_.empty(); }
    std::string_view word() const { return word_; }
    void advance() {
        position_ = std::min(text_.find_first_not_of(blanks, position_), text_.size());
        const std::size_t end = std::min(text_.find_first_of(blanks, position_), text_.size());
        word_ = text_.substr(position_, end - position_);
        position_ = end;
    }
    bool take(std::string_view wanted) {
        if (in_lower_case(word_) != wanted) return false;
        advance();
        return true;
    }
    /// Takes the word in front of "=" of a word such as "Fe=1.2", which keeps the rest.
    bool take_kind(std::string& kind) {
        const std::size_t equals = word_.find('=');
        if (equals == std::string_view::npos || equals == 0) return false;
        kind = word_.substr(0, equals);
        word_.remove_prefix(equals + 1);
        return true;
    }

    /// Returns the part of the word behind "=", or the word if it has none.
    std::string_view value() const { return word_.substr(word_.find('=') + 1); }
    /// Takes "A B", "A:B" or "A,B".
    std::pair<double, double> range() {
        const std::size_t start = position_ - word_.size();
        const std::size_t colon = word_.find_first_of(":,", 1);
        if (colon != std::string_view::npos) { // splits the word
            word_ = word_.substr(0, colon);
            position_ = start + colon + 1;
        }
        const double least = real();
        const double most = real();
        if (!(least < most))
            throw BadInput(option_, "column " + std::to_string(start + 1),
                           "a range must have its lower end first");
        return {least, most};
    }

    std::string got() const { return word_.empty() ? "nothing" : '"' + printable(word_) + '"'; }
    [[noreturn]] void fail(const std::string& message) const {
        const std::size_t column = static_cast<std::size_t>(word_.data() - text_.data()) + 1;
        throw BadInput(option_, "column " + std::to_string(column), message);
    }
    float number(const char* what, float most) {
        const std::optional<float> value = to_float(word_);
        if (!value || !(*value > 0.0F && *value <= most))
            fail(std::string(what) + " must be above 0 and at most " + to_text(most) + ", got " +
                 got());
        advance();
        return *value;
    }

  private:
    double real() {
        const std::optional<double> value = number_in(word_);
        if (!value) fail("must be a number, got " + got());
        advance();
        return *value;
    }

    static constexpr std::string_view blanks = " \t,";
    const std::string& option_;
    std::string_view text_, word_;
    std::size_t position_;
};

/// Takes sizes up to another word; at least one.
void take_sizes(WordList& words, const char* what, SizeWords& sizes) {
    do {
        std::string kind;
        if (words.take_kind(kind))
            sizes.of_kinds.push_back({kind, words.number(what, largest_size)});
        else
            sizes.of_all = words.number(what, largest_size);
    } while (to_float(words.value()));
}

void take_color_of_kind(WordList& words, const std::string& kind, ColorWords& color) {
    const std::optional<std::uint32_t> value = color_named(words.word());
    if (!value)
        words.fail("must be a colour such as red or #ff8000, got " + words.got() +
                   suggestion(words.word(), color_names()));
    color.of_kinds.push_back({kind, *value});
    words.advance();
}

/// Throws for a second word that is not known: one of both may be a misspelled style.
[[noreturn]] void refuse_second(const WordList& words, const std::string& first) {
    std::vector<std::string_view> known = {"opacity", "radius", "scale",
                                           "palette", "range",  "carbons"};
    for (const auto& [name, style] : named_styles())
        known.push_back(name);
    const bool is_color = color_named(first) || first == "element" || first == "chain" ||
                          first == "residue" || is_chain_color(first);
    words.fail("must be one colour, got \"" + printable(first) + "\" and " + words.got() +
               suggestion(is_color ? words.word() : first, known));
}

/// Takes words that belong together in those of a colour.
void take_color(WordList& words, ColorWords& color) {
    std::string kind;
    if (words.take_kind(kind)) {
        take_color_of_kind(words, kind, color);
    } else if (words.take("palette")) {
        color.palette = in_lower_case(words.word());
        const std::vector<std::string_view> names = palette_names();
        if (std::find(names.begin(), names.end(), color.palette) == names.end())
            words.fail("must be " + alternatives({names.begin(), names.end()}) + ", got " +
                       words.got() + suggestion(color.palette, names));
        words.advance();
    } else if (words.take("range")) {
        color.range = words.range();
    } else {
        if (!color.by.empty()) refuse_second(words, color.by);
        color.carbons = words.take("carbons");
        if (words.at_end()) words.fail("must be a colour behind \"carbons\", got nothing");
        color.by = words.word();
        words.advance();
    }
}

std::optional<Style> style_named(std::string_view word) {
    for (const auto& [name, style] : named_styles())
        if (in_lower_case(word) == name) return style;
    return std::nullopt;
}

bool take_style(WordList& words, Look& look) {
    const std::optional<Style> style = style_named(words.word());
    if (!style) return false;
    if (look.style)
        words.fail("must have one style, got " + words.got() +
                   " as well; \"+\" separates styles that are shown at once");
    look.style = style;
    words.advance();
    return true;
}

bool names_style(const std::string& option, const std::string& text) {
    for (WordList words(option, text, 0); !words.at_end(); words.advance())
        if (style_named(words.word())) return true;
    return false;
}

Look look_of(WordList& words, const std::string& option) {
    Look look;
    look.color.option = look.radius.option = look.scale.option = option;
    while (!words.at_end() && words.word() != "+") {
        if (take_style(words, look)) continue;
        if (words.take("opacity"))
            look.opacity = words.number("opacity", 1.0F);
        else if (words.take("radius"))
            take_sizes(words, "radius", look.radius);
        else if (words.take("scale"))
            take_sizes(words, "scale", look.scale);
        else
            take_color(words, look.color);
    }
    return look;
}

} // namespace

const std::vector<std::pair<std::string_view, Style>>& named_styles() {
    static const std::vector<std::pair<std::string_view, Style>> styles = {
        {"balls", Style::balls},       {"sticks", Style::sticks},
        {"licorice", Style::licorice}, {"spheres", Style::spheres},
        {"touching", Style::touching}, {"envelope", Style::envelope},
        {"points", Style::points},     {"polyhedra", Style::polyhedra},
        {"cartoon", Style::cartoon},   {"cylinders", Style::cylinders},
        {"tube", Style::tube},         {"trace", Style::trace}};
    return styles;
}

Representation representation_of(const std::string& option, const std::string& text) {
    const std::size_t colon = separator_in(text);
    Representation representation{.select = text.substr(0, colon), .looks = {}};
    if (representation.select.find_first_not_of(" \t") == std::string::npos)
        throw BadInput(option, "", "must be SELECTION: STYLE, got \"" + printable(text) + '"');
    if (names_style(option, representation.select))
        throw BadInput(
            option, "",
            std::string("must be one SELECTION: STYLE") +
                (colon == std::string::npos ? " with a colon" : "; give each by itself") +
                ", got \"" + printable(text) + '"');
    WordList words(option, text, colon == std::string::npos ? text.size() : colon + 1);
    do {
        representation.looks.push_back(look_of(words, option));
    } while (words.take("+"));
    return representation;
}

Look polyhedra_of(const std::string& option, const std::string& text) {
    WordList words(option, text, 0);
    std::vector<std::string> kinds;
    while (!words.at_end() && (kinds.empty() || element_of(words.word()) != 0)) {
        kinds.emplace_back(words.word());
        words.advance();
    }
    if (kinds.empty()) words.fail("must be an element or type, got nothing");
    Look look = look_of(words, option);
    if (look.style || !words.at_end())
        throw BadInput(option, "", "must have no style, got \"" + printable(text) + '"');
    look.style = Style::polyhedra;
    look.kinds = std::move(kinds);
    return look;
}

ColorWords color_words_of(const std::string& option, const std::string& text) {
    ColorWords color;
    color.option = option;
    WordList words(option, text, 0);
    while (!words.at_end())
        take_color(words, color);
    return color;
}

SizeWords size_words_of(const std::string& option, const std::string& text) {
    SizeWords sizes;
    sizes.option = option;
    WordList words(option, text, 0);
    do {
        take_sizes(words, "a size", sizes);
    } while (!words.at_end());
    return sizes;
}

std::string matches_no_kind(const std::string& option, const std::string& kind) {
    return option + ": \"" + printable(kind) + "\" matches no element or type";
}

std::pair<double, double> range_of(const std::string& option, const std::string& text) {
    WordList words(option, text, 0);
    const std::pair<double, double> range = words.range();
    if (!words.at_end()) words.fail("must be two numbers, got more");
    return range;
}

} // namespace raylane::scenes
