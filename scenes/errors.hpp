#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// The errors that the tool reports. Their text has no control characters, and each of its lines,
/// mostly one, begins with the file.
namespace raylane::scenes {

/// A place in a text.
struct TextPosition {
    std::size_t line = 0;   ///< from 1; 0 where none is known
    std::size_t column = 0; ///< from 1, in characters; 0 where none is known
};

/// One mistake in a file.
struct InputError {
    std::string file; ///< as the user wrote it
    TextPosition position;
    std::string place;   ///< what it is in: a JSON pointer; empty where that is the whole file
    std::string message; ///< "must be positive, got -1"
};

/// "file:line:column: place: message", without what is not there; a line without its end.
std::string text_of(const InputError& error);

/// Input that cannot be meant: a malformed scene, wrong usage. Exit code 2. The text has a line for
/// each error, and another one if there are more.
class BadInput : public std::runtime_error {
  public:
    explicit BadInput(std::vector<InputError> errors, bool more = false);
    /// One error, without a position.
    BadInput(std::string_view file, std::string_view place, std::string_view message);

    /// At least one.
    const std::vector<InputError>& errors() const { return *errors_; }

  private:
    std::shared_ptr<const std::vector<InputError>> errors_; // copies of an exception must not throw
};

/// Collects the mistakes in a file, as many as somebody may want to read at once.
class InputErrors {
  public:
    static constexpr std::size_t most = 10;

    /// Those above `most` are left out.
    void add(const InputError& error);
    void add(const BadInput& bad);
    bool empty() const { return errors_.empty(); }
    /// True if some were left out: there is no need to look for others.
    bool overflowed() const { return overflowed_; }
    /// Throws BadInput, in the order of the file, if there are any.
    void report() const;

  private:
    std::vector<InputError> errors_;
    bool overflowed_ = false;
};

/// The system would not: reading, writing, memory. Exit code 3.
class SystemRefused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// "file: cannot `action`: what strerror says of `error_number`".
    SystemRefused(std::string_view file, std::string_view action, int error_number);

    int error_number = 0; ///< errno's, where it is known
};

/// `text` fit for one line of a message: control characters and bytes that are not UTF-8 as \xNN,
/// cut after `most` characters with "..." behind.
std::string printable(std::string_view text, std::size_t most = 40);

/// A word of a file in quotes; `the end of the file` if it is empty.
std::string quoted_word(std::string_view word);

/// Returns the candidate nearest to `unknown` by edit distance, or the one that another format
/// calls by that word; nothing if no candidate is near.
std::optional<std::string_view> nearest_to(std::string_view unknown,
                                           const std::vector<std::string_view>& candidates);
/// ", did you mean "near"?" with that candidate, behind `prefix`, or "".
std::string suggestion(std::string_view unknown, const std::vector<std::string_view>& candidates,
                       std::string_view prefix = "");

/// "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

} // namespace raylane::scenes
