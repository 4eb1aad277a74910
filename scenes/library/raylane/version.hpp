#pragma once

#include "raylane/api.h"
#include "raylane/version.h"

namespace RAYLANE_API raylane {

/// Version of the library that the program runs with, "0.1.0"; RAYLANE_VERSION is that of the
/// headers that it was compiled with. As long as the first number is 0, the second counts what is
/// not compatible.
RAYLANE_API const char* version() noexcept;
/// The same as a number to compare with RAYLANE_VERSION_NUMBER.
RAYLANE_API int version_number() noexcept;

} // namespace raylane
