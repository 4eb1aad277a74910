#pragma once

#include "core/scene/scene.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/input_file.hpp"
#include "scenes/files/number.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raylane::scenes {

/// The words of an NFF file, separated by blanks, without comments. The file is never held as a
/// whole: memory use is that of one buffer, whatever the size of the file and of its lines.
///
/// Throws BadInput for words of 256 bytes and lines of 1 MiB or more, which no NFF file has, but
/// other files may have.
class NffScanner {
  public:
    explicit NffScanner(InputFile& file);

    /// Returns the next word, on this line or a later one; empty at the end of the file. The word
    /// is valid until the next call.
    std::string_view word();
    /// Returns true if the line has no more words.
    bool at_line_end();
    /// Returns the line of the last word, counted from 1.
    std::uint64_t line() const { return word_line_; }
    /// Returns the number of bytes of the file before the next character.
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
    char* end_;      // a line feed always follows, so that loops need not check for the end
    std::uint64_t passed_ = 0;         // bytes of the file before the buffer's start
    std::uint64_t line_begins_at_ = 0; // offset in the file
    std::uint64_t line_ = 1;
    std::uint64_t word_line_ = 1;
};

/// Reserves memory for the shapes in the rest of a file, assuming that it continues as it began, so
/// that shapes are not copied as their number grows.
class ShapeReserve {
  public:
    /// To be called after each shape or so. Acts once, after 1 MiB. `passed`: bytes of the file.
    void update(core::SceneBuilder& builder, std::uint64_t passed, const InputFile& file);

  private:
    bool is_reserved_ = false;
};

/// The numbers of a statement's fields. `Fields` has take(), the next word, and refuse(field,
/// must, got), which throws.
template <class Fields>
class NumberFields {
  public:
    float number(std::string_view field) {
        const std::string_view word = self().take();
        if (const std::optional<float> value = to_float(word)) {
            self().has_read(word, *value);
            return *value;
        }
        self().refuse(field,
                      is_number(word) ? "must be a number from -1e30 to 1e30"
                                      : "must be a finite number",
                      quoted_word(word));
    }
    int whole_number(std::string_view field, int least, int most) {
        const std::string_view word = self().take();
        const std::optional<int> value = to_int(word);
        if (value && least <= *value && *value <= most) return *value;
        self().refuse(field,
                      "must be a whole number from " + std::to_string(least) + " to " +
                          std::to_string(most),
                      quoted_word(word));
    }
    core::Vec3f triple(std::string_view field) {
        const float x = number(field);
        const float y = number(field);
        const float z = number(field);
        return {x, y, z};
    }

    /// Called for each number.
    void has_read(std::string_view /*word*/, float /*value*/) {}

  private:
    Fields& self() { return static_cast<Fields&>(*this); }
};

} // namespace raylane::scenes
