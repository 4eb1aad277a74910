#include "scenes/web/standard_library.hpp"

#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

namespace {

// musl's functions, which round correctly and ignore the locale.
template <class Number>
Number nearest(const std::string& text) {
    if constexpr (sizeof(Number) == sizeof(float))
        return std::strtof(text.c_str(), nullptr);
    else
        return std::strtod(text.c_str(), nullptr);
}

#ifdef RAYLANE_LACKS_FROM_CHARS

/// Returns the decimal number at the start of a text, in from_chars' syntax, or an empty text.
std::string_view decimal(std::string_view text) {
    std::size_t at = text.starts_with('-') ? 1 : 0;
    std::size_t digits = 0;
    const auto pass_digits = [&] {
        const std::size_t before = at;
        while (at < text.size() && text[at] >= '0' && text[at] <= '9')
            ++at;
        return at - before;
    };
    digits += pass_digits();
    if (at < text.size() && text[at] == '.') {
        ++at;
        digits += pass_digits();
    }
    if (digits == 0) return {};
    const std::size_t mantissa = at;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
        if (pass_digits() == 0) at = mantissa;
    }
    return text.substr(0, at);
}

/// Returns the length of the name of NaN or infinity, with its sign, or 0 without such a name.
std::size_t name_length(std::string_view text, bool& infinite) {
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    const auto has = [&](std::string_view name) {
        if (text.size() < sign + name.size()) return false;
        for (std::size_t i = 0; i < name.size(); ++i)
            if ((text[sign + i] | 0x20) != name[i]) return false;
        return true;
    };
    infinite = has("inf");
    if (has("infinity")) return sign + 8;
    if (infinite) return sign + 3;
    if (!has("nan")) return 0;
    const std::size_t after = sign + 3;
    if (after >= text.size() || text[after] != '(') return after;
    std::size_t end = after + 1;
    while (end < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_'))
        ++end;
    return end < text.size() && text[end] == ')' ? end + 1 : after;
}

template <class Number>
std::from_chars_result read(const char* first, const char* last, Number& value) {
    const std::string_view text(first, static_cast<std::size_t>(last - first));
    const std::string_view number = decimal(text);
    if (number.empty()) {
        bool infinite = false;
        const std::size_t length = name_length(text, infinite);
        if (length == 0) return {first, std::errc::invalid_argument};
        using Limits = std::numeric_limits<Number>;
        value = std::copysign(infinite ? Limits::infinity() : Limits::quiet_NaN(),
                              *first == '-' ? Number(-1) : Number(1));
        return {first + length, std::errc()};
    }
    const char* const end = first + number.size();
    const auto result = nearest<Number>(std::string(number));
    const std::string_view mantissa = number.substr(0, number.find_first_of("eE"));
    const bool vanishes =
        result == 0 && mantissa.find_first_of("123456789") != std::string_view::npos;
    if (vanishes || std::isinf(result)) return {end, std::errc::result_out_of_range};
    value = result;
    return {end, std::errc()};
}

#endif
#ifdef RAYLANE_LACKS_TO_CHARS

/// The number digits * 10^exponent.
struct Decimal {
    std::string digits;
    int exponent;
    std::string text() const { return digits + "e" + std::to_string(exponent); }
};

Decimal rounded(double value, int digits) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
    const std::string_view all(text);
    const std::size_t e = all.find('e');
    Decimal result{std::string(all.substr(0, 1)), std::atoi(text + e + 1) - (digits - 1)};
    if (digits > 1) result.digits += all.substr(2, e - 2);
    return result;
}

/// Returns the next larger number with as many digits.
Decimal next(Decimal decimal) {
    std::size_t at = decimal.digits.size();
    while (at > 0 && decimal.digits[at - 1] == '9')
        decimal.digits[--at] = '0';
    if (at > 0)
        ++decimal.digits[at - 1];
    else
        decimal.digits.insert(0, "1");
    return decimal;
}

/// Returns the shortest decimal number that reads back as a positive `value`. Above a power of two,
/// numbers are twice as far apart as below. So a decimal number that reads back as that power may
/// be farther from it than one that does not.
template <class Number>
Decimal shortest(Number value) {
    int power = 0;
    const bool is_power = std::frexp(value, &power) == Number(0.5);
    for (int digits = 1; digits < std::numeric_limits<Number>::max_digits10; ++digits) {
        const Decimal near = rounded(static_cast<double>(value), digits);
        if (nearest<Number>(near.text()) == value) return near;
        if (is_power && nearest<Number>(next(near).text()) == value) return next(near);
    }
    return rounded(static_cast<double>(value), std::numeric_limits<Number>::max_digits10);
}

/// Formats a number like printf's %f or %e, whichever is shorter. An integer in the form of %f gets
/// its own digits instead of zeros at the end, since they are nearer.
std::string spelled(Decimal decimal, double value) {
    while (decimal.digits.size() > 1 && decimal.digits.back() == '0') {
        decimal.digits.pop_back();
        ++decimal.exponent;
    }
    const int count = static_cast<int>(decimal.digits.size());
    const int leading = decimal.exponent + count - 1; // power of ten of the first digit
    std::string scientific = decimal.digits.substr(0, 1);
    if (count > 1) scientific += "." + decimal.digits.substr(1);
    const std::string power = std::to_string(std::abs(leading));
    scientific += leading < 0 ? "e-" : "e+";
    scientific += (power.size() < 2 ? "0" : "") + power;
    std::string fixed = decimal.digits;
    if (decimal.exponent >= 0) {
        fixed.append(static_cast<std::size_t>(decimal.exponent), '0');
        if (fixed.size() <= scientific.size())
            std::snprintf(fixed.data(), fixed.size() + 1, "%.0f", value);
    } else if (leading >= 0) {
        fixed.insert(static_cast<std::size_t>(leading) + 1, ".");
    } else {
        fixed.insert(0, "0." + std::string(static_cast<std::size_t>(-leading - 1), '0'));
    }
    return fixed.size() <= scientific.size() ? fixed : scientific;
}

template <class Number>
std::to_chars_result write(char* first, char* last, Number value) {
    std::string text = std::signbit(value) ? "-" : "";
    const Number size = std::fabs(value);
    if (std::isnan(value))
        text += "nan";
    else if (std::isinf(value))
        text += "inf";
    else if (size == 0)
        text += "0";
    else
        text += spelled(shortest(size), static_cast<double>(size));
    if (text.size() > static_cast<std::size_t>(last - first))
        return {last, std::errc::value_too_large};
    return {std::copy(text.begin(), text.end(), first), std::errc()};
}

#endif

} // namespace

namespace std {

#ifdef RAYLANE_LACKS_FROM_CHARS
from_chars_result from_chars(const char* first, const char* last, float& value) {
    return read(first, last, value);
}
from_chars_result from_chars(const char* first, const char* last, double& value) {
    return read(first, last, value);
}
#endif
#ifdef RAYLANE_LACKS_TO_CHARS
to_chars_result to_chars(char* first, char* last, float value) {
    return write(first, last, value);
}
to_chars_result to_chars(char* first, char* last, double value) {
    return write(first, last, value);
}

#endif

} // namespace std
