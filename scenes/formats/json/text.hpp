#pragma once

#include "scenes/files/errors.hpp"
#include "scenes/files/input_file.hpp"

#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// The characters of a JSON text, as its parser reads them: each comment and each run of white
/// space is one space. Remembers where the latest tokens began, for messages.
///
/// The parser stores its input until it recognizes a token, and quotes all of it in its errors. So
/// this class drops comments and white space, which can be long, and limits the length of tokens. A
/// file's size alone then costs no memory.
class JsonText {
  public:
    static constexpr std::size_t longest_string = 1 << 16; ///< bytes, with its quotes
    static constexpr std::size_t longest_word = 1 << 10;   ///< bytes of a number or a literal

    struct Token {
        std::size_t index = 0; ///< of its first character, in the parser's input
        TextPosition position;
        std::string
            start; ///< as much of its text as a message may show; empty at the end of the file
    };

    explicit JsonText(InputFile& file);

    /// Returns true if anything except white space and comments has been read.
    bool has_tokens() const { return token_count_ > 0; }
    bool at_end() const { return current_ < 0; }
    char current() const { return static_cast<char>(current_); }
    /// Goes to the next character. Throws BadInput if the text cannot be JSON.
    void advance();

    /// Returns the token that contains the character with this index. It must be one of the latest
    /// three that advance() reached.
    Token token_at(std::size_t index);
    /// Returns the end of the file, once it is reached.
    Token end() const { return {index_, position_, ""}; }
    /// Returns where the token begins that the parser has just recognized. After a number, the
    /// parser has read one character too many, unless the file ends there.
    TextPosition position_of_parsed(bool number) const;
    /// Throws BadInput with the token's position.
    [[noreturn]] void fail(const Token& token, std::string_view message) const;

  private:
    enum class State { between, word, string };

    static constexpr int end_of_file = -1;

    bool fill();
    int peek() {
        if (used_ == buffer_.size() && !fill()) return end_of_file;
        return static_cast<unsigned char>(buffer_[used_]);
    }
    int take();
    int next();
    int next_of_string();
    bool skip_blank();
    void skip_comment(const Token& start);
    void begin_token(State state, int first);
    void grow_token(int character, std::size_t longest, std::string_view what);
    Token& latest() { return tokens_[token_count_ % tokens_.size()]; }
    const Token& token_with(std::size_t index) const;

    InputFile& file_;
    std::vector<char> buffer_;
    std::size_t used_ = 0;
    TextPosition position_{1, 1}; // of the next byte to be taken

    State state_ = State::between;
    bool escaped_ = false; // in a string, after a backslash
    int current_ = 0;
    std::size_t index_ = 0; // of current_
    // The parser asks for a token after reading at most one character ahead, and this class reads
    // one character further ahead.
    std::array<Token, 3> tokens_;
    std::size_t token_count_ = 0;
    std::size_t token_length_ = 0;
};

/// Makes a JsonText a range of characters. An iterator without a text is the end.
class JsonTextIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = char;

    JsonTextIterator() = default;
    explicit JsonTextIterator(JsonText& text) : text_(&text) {}

    char operator*() const { return text_->current(); }
    JsonTextIterator& operator++() {
        text_->advance();
        return *this;
    }
    void operator++(int) { text_->advance(); }
    bool operator==(const JsonTextIterator& other) const { return ended() == other.ended(); }

  private:
    bool ended() const { return text_ == nullptr || text_->at_end(); }

    JsonText* text_ = nullptr;
};

} // namespace raylane::scenes
