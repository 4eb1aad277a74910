#pragma once

#include "scenes/input_file.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

inline bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// Text with the letters A to Z in lower case.
std::string in_lower_case(std::string_view text);

/// A text file line by line, of which no more than a line and a buffer are held. Lines of 1 MiB and
/// more are a BadInput.
class Lines {
  public:
    explicit Lines(InputFile& file);

    /// Goes on to the next line; false at the end of the file. A last line may have no end.
    bool next();
    /// Without what ends it, nor a carriage return before that; until the next call.
    std::string_view text() const { return text_; }
    /// Counted from 1; at the end of the file, one more than there are.
    std::uint64_t number() const { return number_; }
    /// Bytes of the file that are behind.
    std::uint64_t bytes_passed() const { return passed_; }

    /// Has the next call return this line once more.
    void put_back() { is_put_back_ = true; }

    /// Throws BadInput for the line, and a column counted from 1, or 0.
    [[noreturn]] void fail(std::string_view message, std::size_t column = 0) const;

  private:
    bool refill();

    InputFile& file_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0, end_ = 0; // of what is not yet handed out
    std::string_view text_;
    std::uint64_t number_ = 0, passed_ = 0;
    bool is_put_back_ = false, at_end_ = false;
};

/// The words of a line.
class Words {
  public:
    explicit Words(const Lines& lines) : lines_(lines), text_(lines.text()) {}

    /// The next word; empty if there is none.
    std::string_view next();
    /// The next word. Fails: "must have `what`, ...".
    std::string_view get(std::string_view what);
    double number(std::string_view what);
    float coordinate(std::string_view what);
    /// A whole number in a range.
    long long whole(std::string_view what, long long least, long long most);
    /// What is left.
    std::string_view rest();
    /// Column of the last word, from 1.
    std::size_t column() const { return column_; }

    [[noreturn]] void fail(std::string_view message) const { lines_.fail(message, column_); }

  private:
    void skip_blanks();

    const Lines& lines_;
    std::string_view text_;
    std::size_t position_ = 0, column_ = 1;
};

/// A number as files have it: decimal, perhaps with a '+' before it, or a Fortran exponent
/// ("1.D0").
std::optional<double> number_in(std::string_view word);

/// `text` without blanks around it.
std::string_view trimmed(std::string_view text);

} // namespace raylane::scenes
