#pragma once

#include "scenes/files/input_file.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace raylane::scenes {

inline bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// A text file, read line by line. Holds no more than a line and a buffer. Throws BadInput for
/// lines of 1 MiB or more.
class Lines {
  public:
    explicit Lines(InputFile& file);

    /// Goes to the next line. Returns false at the end of the file. The last line may have no end.
    bool next();
    /// Goes to the line of atom `number` of `count`, and fails at the end of the file.
    void next_atom(std::size_t number, std::size_t count);
    /// Returns the line without its end and without a carriage return before that; valid until the
    /// next call.
    std::string_view text() const { return text_; }
    /// Returns the line's number, from 1; at the end of the file, one more than the number of
    /// lines.
    std::uint64_t number() const { return number_; }
    /// Returns how many bytes of the file have been passed.
    std::uint64_t bytes_passed() const { return passed_; }

    /// Makes the next call return this line again.
    void put_back() { is_put_back_ = true; }

    /// Throws BadInput for the line. `column` counts from 1; 0: none.
    [[noreturn]] void fail(std::string_view message, std::size_t column = 0) const;

  private:
    bool refill();

    InputFile& file_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0, end_ = 0; // of the bytes that have not been returned
    std::string_view text_;
    std::uint64_t number_ = 0, passed_ = 0;
    bool is_put_back_ = false, at_end_ = false;
};

/// The words of a line.
class Words {
  public:
    explicit Words(const Lines& lines) : lines_(lines), text_(lines.text()) {}

    /// Returns the next word; empty at the end of the line.
    std::string_view next();
    /// Returns the next word. At the end of the line, throws "must have `what`, ...".
    std::string_view get(std::string_view what);
    double number(std::string_view what);
    float coordinate(std::string_view what);
    /// Returns a whole number in a range.
    long long whole(std::string_view what, long long least, long long most);
    /// Returns the rest of the line.
    std::string_view rest();
    /// Returns the column of the last word, from 1.
    std::size_t column() const { return column_; }

    [[noreturn]] void fail(std::string_view message) const { lines_.fail(message, column_); }

  private:
    void skip_blanks();

    const Lines& lines_;
    std::string_view text_;
    std::size_t position_ = 0, column_ = 1;
};

/// Returns a decimal number, which may have a '+' in front, or a Fortran exponent ("1.D0"); nothing
/// for other words.
std::optional<double> number_in(std::string_view word);

/// Returns `text` without blanks around it.
std::string_view trimmed(std::string_view text);

} // namespace raylane::scenes
