#pragma once

#include <limits>

namespace raylane::core {

/// Hidden, because GCC would otherwise export it where its address is taken.
template <class Real>
[[gnu::visibility("hidden")]] inline constexpr Real
    infinity = std::numeric_limits<Real>::infinity();

} // namespace raylane::core
