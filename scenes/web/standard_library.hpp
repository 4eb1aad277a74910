#pragma once

/// Parts of C++20's standard library that emscripten's, which is LLVM 13's, lacks. Numbers get the
/// same bits as in other libraries. The compiler's flags include this file before all others where
/// that library is used.

#include <algorithm>
#include <bit>
#include <charconv>
#include <functional>
#include <iterator>
#include <type_traits>

namespace std {

#ifndef __cpp_lib_bit_cast
template <class To, class From>
requires(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> &&
         is_trivially_copyable_v<From>) constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}
#endif

#ifndef __cpp_lib_ranges
namespace ranges {
template <class Range, class Predicate>
constexpr bool all_of(const Range& range, Predicate predicate) {
    return std::all_of(std::begin(range), std::end(range),
                       [&](const auto& each) { return std::invoke(predicate, each); });
}
template <class Range, class Out, class Function>
constexpr void transform(const Range& range, Out out, Function function) {
    std::transform(std::begin(range), std::end(range), out,
                   [&](const auto& each) { return std::invoke(function, each); });
}
template <class Range, class Out>
constexpr void copy(const Range& range, Out out) {
    std::copy(std::begin(range), std::end(range), out);
}
template <class Range, class Value>
constexpr void fill(Range& range, const Value& value) {
    std::fill(std::begin(range), std::end(range), value);
}
template <class Range, class Value, class Projection>
constexpr auto find(Range&& range, const Value& value, Projection projection) {
    return std::find_if(std::begin(range), std::end(range),
                        [&](const auto& each) { return std::invoke(projection, each) == value; });
}
template <class Range, class Value, class Compare = std::less<>, class Projection>
constexpr auto lower_bound(Range&& range, const Value& value, Compare compare,
                           Projection projection) {
    return std::lower_bound(std::begin(range), std::end(range), value,
                            [&](const auto& each, const Value& bound) {
                                return compare(std::invoke(projection, each), bound);
                            });
}
template <class Range, class Compare = std::less<>, class Projection>
constexpr void sort(Range& range, Compare compare, Projection projection) {
    std::sort(std::begin(range), std::end(range), [&](const auto& a, const auto& b) {
        return compare(std::invoke(projection, a), std::invoke(projection, b));
    });
}
template <class Range, class Compare = std::less<>, class Projection>
constexpr void stable_sort(Range& range, Compare compare, Projection projection) {
    std::stable_sort(std::begin(range), std::end(range), [&](const auto& a, const auto& b) {
        return compare(std::invoke(projection, a), std::invoke(projection, b));
    });
}
} // namespace ranges
#endif

// libc++ has to_chars since version 14 and from_chars since version 20. It defines the macro only
// once it supports long double, too.
#if !defined(__cpp_lib_to_chars) && !(defined(_LIBCPP_VERSION) && _LIBCPP_VERSION >= 200000)
#define RAYLANE_LACKS_FROM_CHARS
/// Parses the nearest number to a decimal one, independent of the locale.
from_chars_result from_chars(const char* first, const char* last, float& value);
from_chars_result from_chars(const char* first, const char* last, double& value);
#endif

#if !defined(__cpp_lib_to_chars) && !(defined(_LIBCPP_VERSION) && _LIBCPP_VERSION >= 14000)
#define RAYLANE_LACKS_TO_CHARS
/// Writes the shortest decimal number that reads back as `value`, and of these the nearest one.
to_chars_result to_chars(char* first, char* last, float value);
to_chars_result to_chars(char* first, char* last, double value);
#endif

} // namespace std
