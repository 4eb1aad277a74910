#pragma once

#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace raylane::scenes::pov {

/// Returns true for characters of identifiers that are not digits.
inline bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// A file's text. Everything that is read from it refers to it.
struct Source {
    std::string name; ///< for messages
    std::string text;
    std::filesystem::path folder; ///< folder of the files that it includes; empty: none
};

/// A position in a text.
struct Place {
    const Source* source = nullptr;
    std::size_t offset = 0;
};

/// Returns line and column, both from 1.
TextPosition position_of(const Place& place);
[[noreturn]] void fail(const Place& place, std::string_view message);

/// `element`: an array's name with its indices, which Tokens has read.
enum class TokenKind : std::uint8_t { end, word, number, string, symbol, element };

struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text; ///< of a string, the text between its quotes, as written
    double number = 0.0;
    Place place;

    bool is(std::string_view what) const {
        return text == what && (kind == TokenKind::word || kind == TokenKind::symbol);
    }
    template <std::size_t count>
    bool is_one_of(const std::string_view (&all)[count]) const {
        return std::any_of(all, all + count, [&](std::string_view what) { return is(what); });
    }
    /// Returns the token as messages quote it.
    std::string quoted() const;
};

/// The tokens of a text. A copy of a scanner reads the same text again: this implements loops and
/// macros.
class Scanner {
  public:
    explicit Scanner(const Source& source) : source_(&source) {}

    /// Returns the next token, of kind `end` after the last. Throws BadInput.
    Token next();

  private:
    void skip_blanks();
    void skip_comment();
    Token token(TokenKind kind, std::size_t begin, std::size_t end) const;
    Token number();
    Token string();

    const Source* source_;
    std::size_t position_ = 0;
};

} // namespace raylane::scenes::pov
