#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// Conversion of numbers and letters in files, independent of the locale.
namespace raylane::scenes {

inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Returns the float nearest to the decimal number `word`, which may have a leading '+'. Returns
/// nothing if `word` is not a number, is NaN or infinite, or is too large for a float. Numbers too
/// small for a float become 0.
std::optional<float> to_float(std::string_view word);

/// A number at the start of a text.
struct LeadingNumber {
    float value;
    std::size_t length; ///< characters
};

/// Parses the decimal number at the start of a text, if it has the form that most files use: no
/// exponent, no '+', digits that form an integer of at most 2^24, at most ten of them after the
/// point. The result is the same as to_float's and takes less than a third of the time.
std::optional<LeadingNumber> leading_number(std::string_view text);

/// Returns true if `word` is a decimal number of any size.
bool is_number(std::string_view word);

/// Returns true if a decimal number is not 0, but the float nearest to it is.
bool vanishes_in_float(std::string_view number);

/// Returns the integer `word`, or nothing if it is not an integer or does not fit.
std::optional<int> to_int(std::string_view word);

/// Returns the shortest decimal number whose nearest float is `value`.
std::string to_text(float value);

/// Returns to_text(value) as a double, so that 0.001F prints as 0.001 rather than
/// 0.0010000000474974513.
double as_printed(float value);

/// Returns the text with the letters A to Z in lower case.
std::string in_lower_case(std::string_view text);

/// Returns the extension of a file name, such as ".json", in lower case.
std::string ending_of(const std::filesystem::path& path);

} // namespace raylane::scenes
