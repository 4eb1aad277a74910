#pragma once

namespace raylane::core {

/// Pixels x0 <= x < x1, y0 <= y < y1 of a picture.
struct Region {
    int x0;
    int y0;
    int x1;
    int y1;

    int pixels() const { return (x1 - x0) * (y1 - y0); }
};

} // namespace raylane::core
