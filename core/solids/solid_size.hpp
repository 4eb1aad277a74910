#pragma once

#include "core/solids/solid.hpp"

#include <algorithm>
#include <cstddef>

namespace raylane::core {

/// Returns the number of shapes of a solid, including those that only clip it.
inline std::size_t count_parts(const Solid& solid) {
    std::size_t count = solid.made == Made::of_shape ? 1 : 0;
    for (const Solid& part : solid.parts)
        count += count_parts(part);
    return count;
}

/// Returns the number of levels of solids; 1 for a shape.
inline int depth_of(const Solid& solid) {
    int depth = 0;
    for (const Solid& part : solid.parts)
        depth = std::max(depth, depth_of(part));
    return depth + 1;
}

} // namespace raylane::core
