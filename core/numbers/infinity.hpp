#pragma once

#include <limits>

namespace raylane::core {

template <class Real>
inline constexpr Real infinity = std::numeric_limits<Real>::infinity();

} // namespace raylane::core
