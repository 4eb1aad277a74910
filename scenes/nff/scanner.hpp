#pragma once

#include "scenes/input_file.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// The words of an NFF file: what stands between blanks, comments left out. The file is never held
/// whole; whatever its size, and whatever its lines', the memory is that of one buffer.
///
/// Words of 256 bytes and lines of 1 MiB and more, which no NFF file has but any other may, are a
/// BadInput.
class NffScanner {
  public:
    explicit NffScanner(InputFile& file);

    /// The next word, on this line or a later one; empty at the end of the file. It is there until
    /// the next call.
    std::string_view word();
    /// True if the line has no more words.
    bool at_line_end();
    /// Line of the last word, counted from 1.
    std::uint64_t line() const { return word_line_; }
    /// Bytes of the file before the next character.
    std::uint64_t bytes_passed() const { return passed_ + (position_ - buffer_.data()); }

    /// Throws BadInput for this file.
    [[noreturn]] void fail(std::uint64_t line, std::string_view message) const;

  private:
    void skip_blanks();
    void skip_rest_of_line();
    void check_line_length() const;
    bool refill(const char*& keep_from);

    InputFile& file_;
    std::vector<char> buffer_;
    char* position_; // the next character, or end_
    char* end_;      // there is always a line feed, so that no loop has to look for the end
    std::uint64_t passed_ = 0;         // bytes of the file before the buffer's first
    std::uint64_t line_begins_at_ = 0; // byte of the file
    std::uint64_t line_ = 1;
    std::uint64_t word_line_ = 1;
};

} // namespace raylane::scenes
