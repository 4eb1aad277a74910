#pragma once

#include "raylane/api.h"

// The first header that each C++ header includes. A compiler stops at a missing file, so an older
// standard gives this one error. After #error it would continue, with errors about every template.
#if __cplusplus < 202002L
// clang-format off
#include "raylane needs C++20: compile with -std=c++20"
// clang-format on
#endif
