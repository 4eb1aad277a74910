#pragma once

#include "raylane/api.hpp"

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Exceptions of the library. Their messages are one line, except for a BadInput with several
/// mistakes.
namespace RAYLANE_API raylane {

/// Thrown for an invalid value in a scene or an invalid argument.
///
/// `field` names the value relative to the argument, as a JSON pointer without the leading slash
/// ("radius", "pattern/colors/0", "t_max"). It may be empty. `expectation` continues the sentence:
/// "must be positive, got -1". The message is "field: expectation".
class InvalidValue : public std::invalid_argument {
  public:
    InvalidValue(const std::string& field_, const std::string& expectation_)
        : std::invalid_argument(field_.empty() ? expectation_ : field_ + ": " + expectation_),
          field(field_), expectation(expectation_) {}

    std::string field;
    std::string expectation;
};

/// Thrown for a ray whose values contradict each other or the scene. `array` names the span, and
/// `field` is "array/ray": "origin_face/17".
class InvalidRay : public InvalidValue {
  public:
    InvalidRay(const std::string& array_, std::size_t ray_, const std::string& expectation_)
        : InvalidValue(array_ + "/" + std::to_string(ray_), expectation_), array(array_),
          ray(ray_) {}

    std::string array;
    std::size_t ray;
};

/// One mistake in a file.
struct InputError {
    std::string file;       ///< the file's name, as the caller gave it
    std::size_t line = 0;   ///< from 1; 0 if the mistake has no position in the text
    std::size_t column = 0; ///< from 1, in characters; 0 if unknown, as in NFF
    std::string place;      ///< JSON pointer of the value, "/objects/3/radius"; may be empty
    std::string message;    ///< "must be positive, got -1"
};

/// Thrown for invalid input: a malformed scene, an unknown format or a missing file. The message
/// gives the file, the place in it and the expected value: "a.json:12:34: /objects/3/radius: must
/// be positive, got -1".
///
/// The JSON reader continues after a mistake. The message then lists up to ten mistakes in the
/// order of the file, one per line (the last line has no line end), followed by "a.json: and more"
/// if there are others.
class BadInput : public std::runtime_error {
  public:
    BadInput(const std::string& text, std::vector<InputError> errors)
        : std::runtime_error(text),
          errors_(std::make_shared<const std::vector<InputError>>(std::move(errors))) {}

    /// Returns the mistakes in the message, at least one. The reference is valid as long as the
    /// exception or a copy of it.
    const std::vector<InputError>& errors() const noexcept { return *errors_; }

  private:
    std::shared_ptr<const std::vector<InputError>> errors_;
};

/// Thrown if the system fails to read an existing file or to write a file: "out.png: cannot write:
/// No space left on device".
class SystemRefused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace raylane
