#pragma once

#include <array>
#include <cmath>

namespace raylane::scenes {

/// A sum of doubles that is never rounded: parts that do not overlap, the smallest first (Shewchuk
/// 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
/// GROW-EXPANSION with zero elimination).
///
/// Meant for up to 2^24 products of two floats, which are exact as doubles. They are multiples of
/// 2^-298 and less than 2^256, so nothing overflows or underflows. No two neighbouring bits of the
/// parts are both in use (Shewchuk's theorem 10), so there are at most (298 + 256 + 24) / 2 parts.
class ExactSum {
  public:
    void add(double term) {
        int kept = 0;
        for (int i = 0; i < count_; ++i) {
            // Knuth's two-sum: sum + error is exactly term + part.
            const double part = parts_[i];
            const double sum = term + part;
            const double part_used = sum - term;
            const double error = (term - (sum - part_used)) + (part - part_used);
            if (error != 0.0) parts_[kept++] = error;
            term = sum;
        }
        if (term != 0.0) parts_[kept++] = term;
        count_ = kept;
    }

    /// Returns -1, 0 or 1. The largest part outweighs all others.
    int sign() const {
        if (count_ == 0) return 0;
        return parts_[count_ - 1] > 0.0 ? 1 : -1;
    }

    /// Returns the sum within a few ulps.
    double value() const {
        double value = 0.0;
        for (int i = 0; i < count_; ++i)
            value += parts_[i];
        return value;
    }

  private:
    std::array<double, 320> parts_; // not initialized: only the first count_ are valid
    int count_ = 0;
};

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
