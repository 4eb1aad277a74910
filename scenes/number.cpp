#include "scenes/number.hpp"

#include <charconv>
#include <cmath>

namespace raylane::scenes {

namespace {

/// from_chars knows no '+'.
std::string_view without_plus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return word.substr(plus ? 1 : 0);
}

/// Whether a decimal number that from_chars calls out of range is so because it is too small: it
/// does not say.
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

std::optional<float> to_float(std::string_view word) {
    const std::string_view number = without_plus(word);
    const char* const end = number.data() + number.size();
    float value = 0.0F;
    const auto [stop, error] = std::from_chars(number.data(), end, value);
    if (stop != end) return std::nullopt;
    if (error == std::errc::result_out_of_range && underflows(number))
        return number[0] == '-' ? -0.0F : 0.0F;
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    return value;
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

} // namespace raylane::scenes
