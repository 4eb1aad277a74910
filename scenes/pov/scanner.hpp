#pragma once

#include "scenes/errors.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace raylane::scenes::pov {

/// Characters of identifiers.
inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
inline bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// A file's text, which all that is read of it refers to.
struct Source {
    std::string name; ///< for messages
    std::string text;
    std::filesystem::path folder; ///< where files are that it includes; empty: nowhere
};

/// Where something is in a text.
struct Place {
    const Source* source = nullptr;
    std::size_t offset = 0;
};

/// Line and column, both from 1.
TextPosition position_of(const Place& place);
[[noreturn]] void fail(const Place& place, std::string_view message);

/// `element`: an array's name with its indices, which Tokens has read.
enum class TokenKind : std::uint8_t { end, word, number, string, symbol, element };

struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text; ///< of a string what is between its quotes, as it is written
    double number = 0.0;
    Place place;

    bool is(std::string_view what) const {
        return text == what && (kind == TokenKind::word || kind == TokenKind::symbol);
    }
    template <std::size_t count>
    bool is_one_of(const std::string_view (&all)[count]) const {
        return std::any_of(all, all + count, [&](std::string_view what) { return is(what); });
    }
    /// For messages.
    std::string quoted() const;
};

/// The tokens of a text. What is put aside, and taken up again, reads the same text again: that is
/// how loops and macros go.
class Scanner {
  public:
    explicit Scanner(const Source& source) : source_(&source) {}

    /// The next one; of kind `end` behind the last. Throws BadInput.
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
