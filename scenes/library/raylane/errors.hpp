#pragma once

#include <stdexcept>
#include <string>

/// The errors. What all of them say is one line.
namespace raylane {

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

/// A file that cannot be meant: a malformed scene, an unknown format. The text names the file, the
/// place in it and what was expected there: "a.json: /objects/3/radius: must be positive, got -1".
class BadInput : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The system would not read or write: "out.png: cannot write: No space left on device".
class SystemRefused : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace raylane
