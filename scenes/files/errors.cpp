#include "scenes/files/errors.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <tuple>
#include <utility>

namespace raylane::scenes {

namespace {

constexpr std::size_t longest_name = 4096; // of a file, in characters

std::string lines_of(const std::vector<InputError>& errors, bool more) {
    std::string lines;
    for (const InputError& error : errors)
        lines.append(lines.empty() ? "" : "\n").append(text_of(error));
    if (more)
        lines.append("\n").append(printable(errors.back().file, longest_name)).append(": and more");
    return lines;
}

/// Returns the length of the well-formed UTF-8 sequence at the start of `text`, or 0.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const auto continues = [&](std::size_t count) {
        if (text.size() <= count) return false;
        for (std::size_t i = 1; i <= count; ++i)
            if ((byte(i) & 0xC0) != 0x80) return false;
        return true;
    };
    if (byte(0) < 0x80) return 1;
    if (byte(0) >= 0xC2 && byte(0) < 0xE0 && continues(1)) return 2;
    if (byte(0) >= 0xE0 && byte(0) < 0xF0 && continues(2)) {
        const unsigned code = (byte(0) & 0x0FU) << 12 | (byte(1) & 0x3FU) << 6 | (byte(2) & 0x3FU);
        return code >= 0x800 && (code < 0xD800 || code > 0xDFFF) ? 3 : 0;
    }
    if (byte(0) >= 0xF0 && byte(0) < 0xF5 && continues(3)) {
        const unsigned code = (byte(0) & 0x07U) << 18 | (byte(1) & 0x3FU) << 12;
        return code >= 0x10000 && code <= 0x10FFFF ? 4 : 0;
    }
    return 0;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1), before(row), before_that(row);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        before_that.swap(before);
        before.swap(row);
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = before[j] + (a[i] == b[j] ? 0 : 1);
            row[j + 1] = std::min({replaced, row[j] + 1, before[j + 1] + 1});
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                row[j + 1] = std::min(row[j + 1], before_that[j - 1] + 1);
        }
    }
    return row.back();
}

} // namespace

std::string text_of(const InputError& error) {
    std::string text = printable(error.file, longest_name);
    for (const std::size_t number : {error.position.line, error.position.column})
        if (number != 0) text.append(":").append(std::to_string(number));
    if (!error.place.empty()) text.append(": ").append(error.place);
    return text.append(": ").append(error.message);
}

BadInput::BadInput(std::vector<InputError> errors, bool more)
    : std::runtime_error(lines_of(errors, more)),
      errors_(std::make_shared<const std::vector<InputError>>(std::move(errors))) {}

BadInput::BadInput(std::string_view file, std::string_view place, std::string_view message)
    : BadInput({{std::string(file), {}, std::string(place), std::string(message)}}) {}

void InputErrors::add(const InputError& error) {
    if (errors_.size() < most)
        errors_.push_back(error);
    else
        overflowed_ = true;
}

void InputErrors::add(const BadInput& bad) {
    for (const InputError& error : bad.errors())
        add(error);
}

void InputErrors::report() const {
    if (errors_.empty()) return;
    std::vector<std::string> files; // in the order of their first error
    for (const InputError& error : errors_)
        if (std::find(files.begin(), files.end(), error.file) == files.end())
            files.push_back(error.file);
    const auto place = [&](const InputError& error) {
        return std::tuple(std::find(files.begin(), files.end(), error.file), error.position.line,
                          error.position.column);
    };
    std::vector<InputError> sorted; // at most InputErrors::most errors, so insertion is fast enough
    for (const InputError& error : errors_)
        sorted.insert(std::upper_bound(sorted.begin(), sorted.end(), error,
                                       [&](const InputError& a, const InputError& b) {
                                           return place(a) < place(b);
                                       }),
                      error);
    throw BadInput(std::move(sorted), overflowed_);
}

SystemRefused::SystemRefused(std::string_view file, std::string_view action, int number)
    : std::runtime_error(text_of({std::string(file),
                                  {},
                                  "",
                                  "cannot " + std::string(action) + ": " + std::strerror(number)})),
      error_number(number) {}

std::string printable(std::string_view text, std::size_t most) {
    static constexpr std::array<char, 17> hex = {"0123456789ABCDEF"};
    std::string out;
    for (std::size_t characters = 0; !text.empty(); ++characters) {
        if (characters == most) return out + "...";
        const std::size_t length = utf8_length(text);
        const auto first = static_cast<unsigned char>(text[0]);
        if (length == 0 || first < 0x20 || first == 0x7F) {
            out.append("\\x").push_back(hex[first >> 4]);
            out.push_back(hex[first & 15]);
            text.remove_prefix(1);
        } else {
            out.append(text.substr(0, length));
            text.remove_prefix(length);
        }
    }
    return out;
}

namespace {

/// A name that other programs use for one of raylane's keys or options.
struct Synonym {
    std::string_view elsewhere, here;
};
constexpr std::array synonyms = {
    Synonym{"albedo", "color"},
    Synonym{"alpha", "opacity"},
    Synonym{"angle", "field_of_view"},
    Synonym{"bounces", "max_depth"},
    Synonym{"depth", "max_depth"},
    Synonym{"depth", "max-depth"},
    Synonym{"eta", "index"},
    Synonym{"eye", "from"},
    Synonym{"fov", "field_of_view"},
    Synonym{"fovy", "field_of_view"},
    Synonym{"height", "size"},
    Synonym{"ior", "index"},
    Synonym{"jobs", "threads"},
    Synonym{"ka", "ambient"},
    Synonym{"kd", "diffuse"},
    Synonym{"ks", "specular"},
    Synonym{"look_at", "at"},
    Synonym{"lookat", "at"},
    Synonym{"max_bounces", "max_depth"},
    Synonym{"origin", "from"},
    Synonym{"origin", "center"},
    Synonym{"position", "from"},
    Synonym{"position", "center"},
    Synonym{"primitives", "objects"},
    Synonym{"refractive_index", "index"},
    Synonym{"resolution", "image"},
    Synonym{"resolution", "size"},
    Synonym{"samples", "grid"},
    Synonym{"samples", "sampling"},
    Synonym{"samples", "spp"},
    Synonym{"shapes", "objects"},
    Synonym{"shininess", "exponent"},
    Synonym{"size", "image"},
    Synonym{"spp", "grid"},
    Synonym{"spp", "sampling"},
    Synonym{"target", "at"},
    Synonym{"transparency", "opacity"},
    Synonym{"transparency", "transmission"},
    Synonym{"width", "size"},
};

} // namespace

std::optional<std::string_view> nearest_to(std::string_view unknown,
                                           const std::vector<std::string_view>& candidates) {
    const std::string_view start = unknown.substr(0, 64); // a key may be as long as its file
    const auto known = [&](std::string_view name) {
        return std::find(candidates.begin(), candidates.end(), name) != candidates.end();
    };
    for (const Synonym& synonym : synonyms)
        if (synonym.elsewhere == start && known(synonym.here)) return synonym.here;
    // An unknown number is not a misspelled word.
    if (start.find_first_not_of("0123456789+-.") == std::string_view::npos) return std::nullopt;
    const auto nearest =
        std::min_element(candidates.begin(), candidates.end(), [&](auto a, auto b) {
            return edit_distance(start, a) < edit_distance(start, b);
        });
    if (nearest == candidates.end()) return std::nullopt;
    const std::size_t longest = std::max(start.size(), nearest->size());
    if (edit_distance(start, *nearest) > std::max<std::size_t>((longest + 1) / 3, 1))
        return std::nullopt;
    return *nearest;
}

std::string suggestion(std::string_view unknown, const std::vector<std::string_view>& candidates,
                       std::string_view prefix) {
    const std::optional<std::string_view> nearest = nearest_to(unknown, candidates);
    return nearest ? ", did you mean \"" + std::string(prefix).append(*nearest) + "\"?" : "";
}

std::string alternatives(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 < names.size() ? ", " : " or ";
        text += names[i];
    }
    return text;
}

std::string quoted_word(std::string_view word) {
    return word.empty() ? "the end of the file" : '"' + printable(word) + '"';
}

} // namespace raylane::scenes
