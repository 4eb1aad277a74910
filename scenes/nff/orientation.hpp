#pragma once

#include "scenes/nff/exact_sum.hpp"

#include <cmath>

namespace raylane::scenes {

/// A point in the plane. Its coordinates are floats, stored as doubles for computing.
struct PlanePoint {
    double x, y;

    bool operator==(const PlanePoint&) const = default;
};

/// Returns 1 if a, b, c turn left, -1 if they turn right, and 0 if they are collinear. Always
/// correct: a sign that double precision cannot decide (Shewchuk's first bound, 1997) is computed
/// without rounding.
inline int orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    const double left = (b.x - a.x) * (c.y - a.y);
    const double right = (b.y - a.y) * (c.x - a.x);
    // A product of differences is 0 only if a difference is: differences of floats do not
    // underflow.
    if (left == 0.0 && right == 0.0) return 0;
    constexpr double unit = 0x1p-53;
    const double bound = (3.0 + 16.0 * unit) * unit * (std::abs(left) + std::abs(right));
    if (left - right > bound) return 1;
    if (right - left > bound) return -1;
    ExactSum area;
    for (const double product :
         {a.x * b.y, -a.y * b.x, b.x * c.y, -b.y * c.x, c.x * a.y, -c.y * a.x})
        area.add(product);
    return area.sign();
}

} // namespace raylane::scenes
