#pragma once

#include "raylane/raylane.h"
#include "raylane/raylane.hpp"
#include "scenes/api/cpp/convert.hpp"

#include <string>

/// Conversions between the values of the C++ library and those of the C interface. Enumerators have
/// the same numbers on both sides, and the library rejects invalid ones.
namespace raylane::c {

using library::converted;

/// Converts an enumerator from an int. Throws InvalidValue outside of 0 to 255; the library rejects
/// other invalid ones.
template <class Enum>
Enum enum_from_int(const char* name, int number) {
    if (number < 0 || number > 255)
        throw InvalidValue(name, "must be one of its enumerators, got " + std::to_string(number));
    return static_cast<Enum>(number);
}

} // namespace raylane::c
