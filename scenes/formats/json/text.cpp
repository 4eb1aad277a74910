#include "scenes/formats/json/text.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

constexpr std::size_t buffer_size = 64 << 10;
constexpr std::size_t longest_quote = 40; // characters of a token that a message shows
constexpr std::size_t kept_of_token = 4 * (longest_quote + 1);

bool is_space(int c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_structural(int c) {
    return c == '{' || c == '}' || c == '[' || c == ']' || c == ':' || c == ',';
}

bool ends_word(int c) {
    return c <= 0x20 || is_structural(c) || c == '"' || c == '/';
}

} // namespace

JsonText::JsonText(InputFile& file) : file_(file) {
    current_ = next();
}

void JsonText::advance() {
    ++index_;
    current_ = next();
}

JsonText::Token JsonText::token_at(std::size_t index) {
    // The parser abandons a word at the first invalid letter, but a message shows all of it.
    while (state_ == State::word && latest().start.size() < kept_of_token && !ends_word(peek()))
        latest().start += static_cast<char>(take());
    Token token = token_with(index);
    token.start = printable(token.start, longest_quote);
    return token;
}

const JsonText::Token& JsonText::token_with(std::size_t index) const {
    std::size_t back = 0;
    const auto token = [&]() -> const Token& {
        return tokens_[(token_count_ - back) % tokens_.size()];
    };
    while (token().index > index && back + 1 < tokens_.size() && back + 1 < token_count_)
        ++back;
    return token();
}

TextPosition JsonText::position_of_parsed(bool number) const {
    const bool one_further = number && !(at_end() && state_ == State::word);
    return token_with(index_ - (one_further ? 2 : 1)).position;
}

void JsonText::fail(const Token& token, std::string_view message) const {
    throw BadInput({{file_.name(), token.position, "", std::string(message)}});
}

bool JsonText::fill() {
    buffer_.resize(buffer_size);
    buffer_.resize(file_.read(buffer_));
    used_ = 0;
    return !buffer_.empty();
}

int JsonText::take() {
    const int c = peek();
    if (c == end_of_file) return c;
    ++used_;
    if (c == '\n') {
        ++position_.line;
        position_.column = 1;
    } else if ((c & 0xC0) != 0x80) { // the bytes of one character count once
        ++position_.column;
    }
    return c;
}

int JsonText::next() {
    if (state_ == State::string) return next_of_string();
    if (skip_blank()) {
        state_ = State::between;
        return ' ';
    }
    const int c = peek();
    if (c == end_of_file) return c;
    if (is_structural(c)) {
        begin_token(State::between, c);
    } else if (c == '"') {
        begin_token(State::string, c);
    } else if (c < 0x20) {
        fail({index_, position_, ""},
             "must be JSON, got the byte " + printable(std::string(1, static_cast<char>(c))));
    } else if (state_ == State::between) {
        begin_token(State::word, c);
    } else {
        grow_token(c, longest_word, "a value");
    }
    return take();
}

int JsonText::next_of_string() {
    const int c = peek();
    if (c == end_of_file || c == '\n' || c == '\r')
        fail(token_at(index_),
             "must be a string that ends on its line, got " + token_at(index_).start);
    if (c == '"' && !escaped_) state_ = State::between;
    grow_token(c, longest_string, "a string");
    escaped_ = c == '\\' && !escaped_;
    return take();
}

bool JsonText::skip_blank() {
    bool skipped = false;
    for (int c = peek(); is_space(c) || c == '/'; c = peek(), skipped = true) {
        const Token start{index_, position_, "/"};
        take();
        if (c == '/') skip_comment(start);
    }
    return skipped;
}

void JsonText::skip_comment(const Token& start) {
    const int kind = take();
    if (kind == '/') {
        while (peek() != end_of_file && peek() != '\n')
            take();
    } else if (kind == '*') {
        int before = 0;
        for (int c = take(); !(before == '*' && c == '/'); c = take()) {
            if (c == end_of_file) fail(start, "must be a comment that ends with */");
            before = c;
        }
    } else {
        fail(start, "must be JSON, got /");
    }
}

void JsonText::begin_token(State state, int first) {
    state_ = state;
    ++token_count_;
    token_length_ = 1;
    latest() = {index_, position_, std::string(1, static_cast<char>(first))};
}

void JsonText::grow_token(int character, std::size_t longest, std::string_view what) {
    if (latest().start.size() < kept_of_token) latest().start += static_cast<char>(character);
    if (++token_length_ <= longest) return;
    fail(latest(), "must be " + std::string(what) + " of at most " + std::to_string(longest) +
                       " bytes, got " + token_at(index_).start);
}

} // namespace raylane::scenes
