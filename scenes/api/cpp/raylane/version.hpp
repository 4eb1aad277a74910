#pragma once

#include "raylane/api.hpp"
#include "raylane/version.h"

namespace RAYLANE_API raylane {

/// Returns the version of the library that the program runs with, such as "0.1.0". RAYLANE_VERSION
/// is the version of the headers that the program was compiled with. While the first number is 0,
/// an incompatible change increases the second.
RAYLANE_API const char* version() noexcept;
/// Returns the same version as a number, to compare with RAYLANE_VERSION_NUMBER.
RAYLANE_API int version_number() noexcept;

} // namespace raylane
