#pragma once

#include "core/solids/solid.hpp"

#include <algorithm>
#include <cstddef>

namespace raylane::core {

/// Shapes that a solid is made of, those that only clip it included.
inline std::size_t count_parts(const Solid& solid) {
    std::size_t count = solid.made == Made::of_shape ? 1 : 0;
    for (const Solid& part : solid.parts)
        count += count_parts(part);
    return count;
}

/// Levels of solids within it: 1 of a shape.
inline int depth_of(const Solid& solid) {
    int depth = 0;
    for (const Solid& part : solid.parts)
        depth = std::max(depth, depth_of(part));
    return depth + 1;
}

} // namespace raylane::core
