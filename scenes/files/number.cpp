#include "scenes/files/number.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace raylane::scenes {

namespace {

/// Removes a leading '+', which from_chars does not accept.
std::string_view without_plus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return word.substr(plus ? 1 : 0);
}

/// Returns true if a decimal number is too small. Call it only for numbers that from_chars reports
/// as out of range, since from_chars does not distinguish too small from too large.
bool underflows(std::string_view number) {
    const std::size_t e = number.find_first_of("eE");
    const std::string_view mantissa = number.substr(0, e);
    const std::size_t first = mantissa.find_first_of("123456789");
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    long long exponent = 0; // of the leading digit
    if (e != std::string_view::npos) {
        const std::string_view text = without_plus(number.substr(e + 1));
        if (std::from_chars(text.data(), text.data() + text.size(), exponent).ec != std::errc())
            return text[0] == '-';
    }
    const auto leading = static_cast<long long>(point) - static_cast<long long>(first);
    return leading + exponent < 0;
}

} // namespace

// The digits and the power of ten are exact in float, and their quotient is rounded once. So the
// result is the one that from_chars gives.
std::optional<LeadingNumber> leading_number(std::string_view text) {
    constexpr std::array<float, 11> powers = {1e0F, 1e1F, 1e2F, 1e3F, 1e4F, 1e5F,
                                              1e6F, 1e7F, 1e8F, 1e9F, 1e10F};
    constexpr std::size_t longest = 18; // the digits fit into 64 bits
    const std::size_t first = text.starts_with('-') ? 1 : 0;
    std::uint64_t digits = 0;
    std::size_t end = first, point = 0; // index after the point; 0: no point
    for (; end < text.size(); ++end) {
        const char c = text[end];
        if (c >= '0' && c <= '9') {
            digits = 10 * digits + static_cast<std::uint64_t>(c - '0');
        } else if (c == '.' && point == 0) {
            point = end + 1;
        } else {
            break;
        }
        if (end >= longest) return std::nullopt;
    }
    const std::size_t count = end - first - (point != 0 ? 1 : 0);
    const std::size_t behind_point = point != 0 ? end - point : 0;
    if (count == 0 || digits > 1 << 24 || behind_point >= powers.size()) return std::nullopt;
    const float value = static_cast<float>(digits) / powers[behind_point];
    return LeadingNumber{first == 1 ? -value : value, end};
}

std::optional<float> to_float(std::string_view word) {
    const std::string_view number = without_plus(word);
    if (const auto leading = leading_number(number); leading && leading->length == number.size())
        return leading->value;
    const char* const end = number.data() + number.size();
    float value = 0.0F;
    const auto [stop, error] = std::from_chars(number.data(), end, value);
    if (stop != end) return std::nullopt;
    if (error == std::errc::result_out_of_range && underflows(number))
        return number[0] == '-' ? -0.0F : 0.0F;
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    return value;
}

bool is_number(std::string_view word) {
    const std::string_view number = without_plus(word);
    const char* const end = number.data() + number.size();
    double value = 0.0;
    const auto [rest, error] = std::from_chars(number.data(), end, value);
    return rest == end && (error == std::errc::result_out_of_range ||
                           (error == std::errc() && std::isfinite(value)));
}

bool vanishes_in_float(std::string_view number) {
    const std::string_view mantissa = number.substr(0, number.find_first_of("eE"));
    return to_float(number) == 0.0F &&
           mantissa.find_first_of("123456789") != std::string_view::npos;
}

std::optional<int> to_int(std::string_view word) {
    const std::string_view number = without_plus(word);
    const char* const end = number.data() + number.size();
    int value = 0;
    const auto [stop, error] = std::from_chars(number.data(), end, value);
    if (stop != end || error != std::errc()) return std::nullopt;
    return value;
}

std::string to_text(float value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

double as_printed(float value) {
    const std::string text = to_text(value);
    auto number = static_cast<double>(value);
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

std::string in_lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

std::string ending_of(const std::filesystem::path& path) {
    return in_lower_case(path.extension().string());
}

} // namespace raylane::scenes
