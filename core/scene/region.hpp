#pragma once

#include <algorithm>

namespace raylane::core {

/// Pixels x0 <= x < x1, y0 <= y < y1 of an image.
struct Region {
    int x0;
    int y0;
    int x1;
    int y1;

    int pixels() const { return (x1 - x0) * (y1 - y0); }
    bool operator==(const Region&) const = default;

    /// Returns the intersection of both, which must not be empty.
    Region within(const Region& other) const {
        return {std::max(x0, other.x0), std::max(y0, other.y0), std::min(x1, other.x1),
                std::min(y1, other.y1)};
    }
};

} // namespace raylane::core
