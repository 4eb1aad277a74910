#include "scenes/formats/pov/expressions.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace raylane::scenes::pov {

namespace {

/// Formats a number as str() does: at least `length` characters, padded with zeros if negative, and
/// `decimals` decimals, six if negative.
std::string formatted(double number, double length, double decimals) {
    constexpr double most = 300.0;
    const int width = static_cast<int>(std::clamp(length, -most, most));
    const int precision = decimals < 0.0 ? 6 : static_cast<int>(std::min(decimals, most));
    std::array<char, 1024> text{}; // 309 digits before the point, or as wide as that
    const char* format = width < 0 ? "%0*.*f" : "%*.*f";
    const int size =
        std::snprintf(text.data(), text.size(), format, std::abs(width), precision, number);
    return {text.data(), static_cast<std::size_t>(std::max(size, 0))};
}

double next_number(Tokens& tokens) {
    tokens.expect(",");
    return read_number(tokens);
}

/// Reads "str(NUMBER, LENGTH, DECIMALS)" and "vstr(COUNT, VECTOR, BETWEEN, LENGTH, DECIMALS)".
std::string read_str(Tokens& tokens, bool is_vector) {
    tokens.expect("(");
    Tuple numbers;
    std::string between;
    const Place place = tokens.peek().place;
    if (is_vector) {
        const double count = read_number(tokens);
        if (!(count >= 1.0 && count < 6.0)) fail(place, "must be a number of components, 1 to 5");
        tokens.expect(",");
        numbers = read_tuple(tokens);
        if (numbers.size == 1) numbers.at.fill(numbers.at[0]);
        numbers.size = static_cast<int>(count);
        tokens.expect(",");
        between = read_string(tokens);
    } else {
        numbers.at[0] = read_number(tokens);
    }
    const double length = next_number(tokens), decimals = next_number(tokens);
    tokens.expect(")");
    std::string text;
    for (int i = 0; i < numbers.size; ++i)
        text += (i == 0 ? "" : between) +
                formatted(numbers.at[static_cast<std::size_t>(i)], length, decimals);
    return text;
}

std::string read_concat(Tokens& tokens, const Place& place) {
    std::string text;
    tokens.expect("(");
    do {
        text += read_string(tokens);
        if (text.size() > longest_string)
            fail(place,
                 "must be a string of at most " + std::to_string(longest_string) + " characters");
    } while (tokens.accept(","));
    tokens.expect(")");
    return text;
}

/// Reads "substr(TEXT, FIRST, COUNT)"; the first character is 1.
std::string read_substr(Tokens& tokens, const Place& place) {
    tokens.expect("(");
    const std::string text = read_string(tokens);
    const double first = next_number(tokens), count = next_number(tokens);
    tokens.expect(")");
    if (!(first >= 1.0 && count >= 0.0 && first + count - 1.0 <= static_cast<double>(text.size())))
        fail(place, "must be of characters that the string has");
    return text.substr(static_cast<std::size_t>(first) - 1, static_cast<std::size_t>(count));
}

/// Reads "chr(CODE)", a Unicode character.
std::string read_chr(Tokens& tokens) {
    tokens.expect("(");
    const Place place = tokens.peek().place;
    const double number = read_number(tokens);
    tokens.expect(")");
    if (!(number >= 1.0 && number < 65536.0))
        fail(place, "must be the code of a character, from 1 to 65535");
    const auto code = static_cast<unsigned>(number);
    const auto byte = [](unsigned bits) { return static_cast<char>(bits); };
    const char last = byte(0x80 | (code & 0x3F)), middle = byte(0x80 | (code >> 6 & 0x3F));
    if (code < 0x80) return {byte(code)};
    if (code < 0x800) return {byte(0xC0 | code >> 6), last};
    return {byte(0xE0 | code >> 12), middle, last};
}

char in_case(char c, bool upper) {
    const char first = upper ? 'a' : 'A';
    return c >= first && c <= first + 25 ? static_cast<char>(c ^ ' ') : c;
}

std::string read_in_case(Tokens& tokens, bool upper) {
    tokens.expect("(");
    std::string text = read_string(tokens);
    tokens.expect(")");
    for (char& c : text)
        c = in_case(c, upper);
    return text;
}

constexpr std::string_view functions[] = {"chr",    "concat", "str",   "vstr",
                                          "substr", "strlwr", "strupr"};

std::string read_one(Tokens& tokens, const Token& token) {
    const Level level(tokens.depth, token.place);
    if (token.kind == TokenKind::string) return std::string(token.text);
    if (const Value* value = tokens.value_of(token))
        if (const auto* text = value->get_if<std::string>()) return *text;
    if (token.is("str") || token.is("vstr")) return read_str(tokens, token.is("vstr"));
    if (token.is("chr")) return read_chr(tokens);
    if (token.is("concat")) return read_concat(tokens, token.place);
    if (token.is("substr")) return read_substr(tokens, token.place);
    if (token.is("strlwr") || token.is("strupr")) return read_in_case(tokens, token.is("strupr"));
    fail(token.place, "must be a string, got " + token.quoted());
}

} // namespace

bool begins_string(const Token& token) {
    return token.kind == TokenKind::string || token.is_one_of(functions);
}

std::string read_string(Tokens& tokens) {
    const Token token = tokens.next();
    std::string text = read_one(tokens, token);
    tokens.budget.keep(text.size(), token.place);
    return text;
}

} // namespace raylane::scenes::pov
