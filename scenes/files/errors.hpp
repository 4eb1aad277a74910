#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// The errors that the tool reports. Their text contains no control characters. It usually has one
/// line, and each line begins with the file's name.
namespace raylane::scenes {

/// A place in a text.
struct TextPosition {
    std::size_t line = 0;   ///< from 1; 0 if unknown
    std::size_t column = 0; ///< from 1, in characters; 0 if unknown
};

/// One mistake in a file.
struct InputError {
    std::string file; ///< as the user wrote it
    TextPosition position;
    std::string place;   ///< where in the file: a JSON pointer; empty for the whole file
    std::string message; ///< "must be positive, got -1"
};

/// Returns "file:line:column: place: message" without a line feed. Missing parts are left out.
std::string text_of(const InputError& error);

/// Invalid input, such as a malformed scene or wrong usage. Exit code 2. The text has one line per
/// error, and one more if errors were left out.
class BadInput : public std::runtime_error {
  public:
    explicit BadInput(std::vector<InputError> errors, bool more = false);
    /// Makes a single error without a position.
    BadInput(std::string_view file, std::string_view place, std::string_view message);

    /// Returns the errors; there is at least one.
    const std::vector<InputError>& errors() const { return *errors_; }

  private:
    std::shared_ptr<const std::vector<InputError>> errors_; // copies of an exception must not throw
};

/// Collects the errors in a file, up to the number that a user may want to read at once.
class InputErrors {
  public:
    static constexpr std::size_t most = 10;

    /// Adds an error. Those beyond `most` are dropped.
    void add(const InputError& error);
    void add(const BadInput& bad);
    bool empty() const { return errors_.empty(); }
    /// Returns true if errors were dropped; then the caller need not look for more.
    bool overflowed() const { return overflowed_; }
    /// Throws BadInput if there are any errors, sorted by their position in the file.
    void report() const;

  private:
    std::vector<InputError> errors_;
    bool overflowed_ = false;
};

/// The system refused an operation: reading, writing, memory. Exit code 3.
class SystemRefused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// Makes the text "file: cannot `action`: strerror(`error_number`)".
    SystemRefused(std::string_view file, std::string_view action, int error_number);

    int error_number = 0; ///< errno, if known
};

/// Returns `text` in a form fit for one line of a message. Control characters and bytes that are
/// not UTF-8 become \xNN. Text beyond `most` characters is replaced by "...".
std::string printable(std::string_view text, std::size_t most = 40);

/// Returns a word of a file in quotes, or `the end of the file` if it is empty.
std::string quoted_word(std::string_view word);

/// Returns the candidate that other programs call `unknown`. Without one, returns the candidate
/// nearest to `unknown` by edit distance, or nothing if none is near.
std::optional<std::string_view> nearest_to(std::string_view unknown,
                                           const std::vector<std::string_view>& candidates);
/// Returns `, did you mean "near"?` with that candidate, preceded by `prefix`, or "" without one.
std::string suggestion(std::string_view unknown, const std::vector<std::string_view>& candidates,
                       std::string_view prefix = "");

/// Returns the names as "a, b or c".
std::string alternatives(const std::vector<std::string>& names);

} // namespace raylane::scenes
