#pragma once

#include "raylane/api.h"

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// The errors. What they say is one line, but for a BadInput that holds several mistakes.
namespace RAYLANE_API raylane {

/// A value that no scene may hold, or that no function may be called with.
///
/// `field` names it relative to what was passed in, like a JSON pointer without the leading slash
/// ("radius", "pattern/colors/0", "t_max"); it may be empty. `expectation` reads on from there:
/// "must be positive, got -1".
class InvalidValue : public std::invalid_argument {
  public:
    InvalidValue(const std::string& field_, const std::string& expectation_)
        : std::invalid_argument(field_.empty() ? expectation_ : field_ + ": " + expectation_),
          field(field_), expectation(expectation_) {}

    std::string field;
    std::string expectation;
};

/// One mistake in a file.
struct InputError {
    std::string file;       ///< as it was named
    std::size_t line = 0;   ///< from 1; 0 where the mistake has no place in the text
    std::size_t column = 0; ///< from 1, in characters; 0 where it is not known, as in NFF
    std::string place;      ///< the JSON pointer of a value, "/objects/3/radius"; may be empty
    std::string message;    ///< "must be positive, got -1"
};

/// A file that cannot be meant: a malformed scene, an unknown format, one that is not there. The
/// text names the file, the place in it and what was expected there: "a.json:12:34:
/// /objects/3/radius: must be positive, got -1".
///
/// A scene in JSON is read on behind a mistake. Up to ten are told, each on a line of its own (the
/// last has no line end), in the order of the file; then "a.json: and more" if there are more.
class BadInput : public std::runtime_error {
  public:
    BadInput(const std::string& text, std::vector<InputError> errors)
        : std::runtime_error(text),
          errors_(std::make_shared<const std::vector<InputError>>(std::move(errors))) {}

    /// The mistakes that the text tells of, at least one; they live as long as the exception or a
    /// copy of it.
    const std::vector<InputError>& errors() const noexcept { return *errors_; }

  private:
    std::shared_ptr<const std::vector<InputError>> errors_;
};

/// The system would not read or write a file that is there, or a new one: "out.png: cannot write:
/// No space left on device".
class SystemRefused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace raylane
