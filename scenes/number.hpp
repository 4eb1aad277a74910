#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Numbers as files spell them, in any locale.
namespace raylane::scenes {

/// The float nearest to the decimal number that `word` is; a sign in front may be '+'. Nothing if
/// it is no number, not a number by name, infinite, or too large for a float. One too small for a
/// float is 0.
std::optional<float> to_float(std::string_view word);

/// A number that a text begins with.
struct LeadingNumber {
    float value;
    std::size_t length; ///< characters
};

/// The decimal number that a text begins with, if it is such as most files hold: without exponent
/// or '+', digits below 2^24, at most ten of them behind the point; as to_float has it, in less
/// than a third of the time.
std::optional<LeadingNumber> leading_number(std::string_view text);

/// True if `word` is a decimal number, of any size.
bool is_number(std::string_view word);

/// True if the float nearest to a decimal number is 0, and the number is not.
bool vanishes_in_float(std::string_view number);

/// The whole number that `word` is. Nothing if it is none or does not fit.
std::optional<int> to_int(std::string_view word);

/// The shortest decimal number that is nearest to `value` among floats.
std::string to_text(float value);

/// That number as a double: what prints 0.001F as 0.001 rather than 0.0010000000474974513.
double as_printed(float value);

} // namespace raylane::scenes
