#pragma once

#include <stdexcept>
#include <string>

namespace raylane::core {

/// Reports a value that a scene must not hold.
///
/// `field` names it relative to the object that was being added, like a JSON pointer without the
/// leading slash ("radius", "edges/2"); it may be empty. `expectation` continues the field's name:
/// "must be positive, got -1". A reader puts the file and the place in front.
class InvalidValue : public std::invalid_argument {
  public:
    InvalidValue(std::string field_, std::string expectation_)
        : std::invalid_argument(field_.empty() ? expectation_ : field_ + ": " + expectation_),
          field(std::move(field_)), expectation(std::move(expectation_)) {}

    std::string field;
    std::string expectation;
};

} // namespace raylane::core
