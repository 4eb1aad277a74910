#include "scenes/formats/pov/scanner.hpp"

#include <algorithm>
#include <charconv>

namespace raylane::scenes::pov {

namespace {

constexpr std::size_t longest_word = 256;

bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

} // namespace

TextPosition position_of(const Place& place) {
    const std::string_view before = std::string_view(place.source->text).substr(0, place.offset);
    const std::size_t line_begin = before.rfind('\n') + 1; // of npos that is 0
    const auto is_first_byte = [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    };
    return {static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1,
            static_cast<std::size_t>(
                std::count_if(before.begin() + static_cast<std::ptrdiff_t>(line_begin),
                              before.end(), is_first_byte)) +
                1};
}

void fail(const Place& place, std::string_view message) {
    throw BadInput({{place.source->name, position_of(place), "", std::string(message)}});
}

std::string Token::quoted() const {
    if (kind == TokenKind::end) return "the end of the file";
    std::string quoted = kind == TokenKind::string ? "the string \"" : "\"";
    return quoted.append(printable(text)).append("\"");
}

Token Scanner::token(TokenKind kind, std::size_t begin, std::size_t end) const {
    return {
        kind, std::string_view(source_->text).substr(begin, end - begin), 0.0, {source_, begin}};
}

/// Skips a comment. Comments may be nested.
void Scanner::skip_comment() {
    const std::string& text = source_->text;
    const std::size_t begin = position_;
    int depth = 0;
    do {
        const std::size_t at = text.find_first_of("*/", position_);
        if (at == std::string::npos || at + 1 == text.size())
            fail({source_, begin}, "must have an end, got a comment without \"*/\"");
        const bool begins = text[at] == '/' && text[at + 1] == '*';
        const bool ends = text[at] == '*' && text[at + 1] == '/';
        depth += begins ? 1 : ends ? -1 : 0;
        position_ = at + (begins || ends ? 2 : 1);
    } while (depth > 0);
}

void Scanner::skip_blanks() {
    const std::string& text = source_->text;
    while (position_ < text.size()) {
        if (is_blank(text[position_])) {
            ++position_;
        } else if (text.compare(position_, 2, "//") == 0) {
            position_ = std::min(text.find('\n', position_), text.size());
        } else if (text.compare(position_, 2, "/*") == 0) {
            skip_comment();
        } else {
            return;
        }
    }
}

Token Scanner::number() {
    const char* begin = source_->text.data() + position_;
    const char* last = source_->text.data() + source_->text.size();
    Token result;
    const auto [end, error] = std::from_chars(begin, last, result.number);
    const std::size_t first = position_;
    position_ += static_cast<std::size_t>(end - begin);
    const double value = result.number;
    result = token(TokenKind::number, first, position_);
    result.number = value;
    if (error == std::errc::result_out_of_range) {
        // A number that is too small is 0.
        const std::size_t exponent = result.text.find_first_of("eE");
        if (exponent == std::string_view::npos || result.text.substr(exponent + 1, 1) != "-")
            fail(result.place, "must be a number that a double has, got " + result.quoted());
        result.number = 0.0;
    }
    return result;
}

Token Scanner::string() {
    const std::string& text = source_->text;
    const std::size_t first = position_++;
    for (; position_ < text.size() && text[position_] != '"'; ++position_)
        if (text[position_] == '\\') ++position_;
    if (position_ >= text.size())
        fail({source_, first}, "must have an end, got a string without a second quote");
    Token result = token(TokenKind::string, first + 1, position_++);
    result.place.offset = first;
    return result;
}

Token Scanner::next() {
    skip_blanks();
    const std::string& text = source_->text;
    if (position_ >= text.size()) return token(TokenKind::end, text.size(), text.size());
    const char c = text[position_];
    const char after = position_ + 1 < text.size() ? text[position_ + 1] : '\0';
    const std::size_t first = position_;
    if (is_letter(c)) {
        while (position_ < text.size() && (is_letter(text[position_]) || is_digit(text[position_])))
            ++position_;
        const Token word = token(TokenKind::word, first, position_);
        if (word.text.size() >= longest_word)
            fail(word.place, "must be shorter than 256 letters, got " + word.quoted());
        return word;
    }
    if (is_digit(c) || (c == '.' && is_digit(after))) return number();
    if (c == '"') return string();
    const bool is_double = after == '=' && (c == '<' || c == '>' || c == '!');
    position_ += is_double ? 2 : 1;
    if (std::string_view("{}()<>[],;.+-*/=!&|?:#").find(c) == std::string_view::npos)
        fail({source_, first}, "must be of POV-Ray's language, got " +
                                   token(TokenKind::symbol, first, position_).quoted());
    return token(TokenKind::symbol, first, position_);
}

} // namespace raylane::scenes::pov
