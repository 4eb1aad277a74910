#pragma once

#include "core/numbers/infinity.hpp"
#include "core/numbers/vector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::core {

/// A closed axis-aligned box. Empty if lower > upper in any axis.
struct Bounds {
    Vec3f lower{std::numeric_limits<float>::infinity()};
    Vec3f upper{-std::numeric_limits<float>::infinity()};

    void include(const Bounds& other) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], other.lower[axis]);
            upper[axis] = std::max(upper[axis], other.upper[axis]);
        }
    }

    template <class Real>
    bool contains(const Vec3<Real>& p) const {
        bool is_in = true;
        for (int axis = 0; axis < 3; ++axis)
            is_in = is_in && Real(lower[axis]) <= p[axis] && p[axis] <= Real(upper[axis]);
        return is_in;
    }

    bool meets(const Bounds& other) const {
        bool do_meet = true;
        for (int axis = 0; axis < 3; ++axis)
            do_meet =
                do_meet && lower[axis] <= other.upper[axis] && other.lower[axis] <= upper[axis];
        return do_meet;
    }

    /// Returns half of the surface area; 0 if empty. Computes in double, where it cannot overflow.
    double half_area() const {
        const Vec3d size = convert<double>(upper) - convert<double>(lower);
        if (!(size.x >= 0.0 && size.y >= 0.0 && size.z >= 0.0)) return 0.0;
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

/// Extends bounds to include a point, rounded outwards.
template <class Real>
void include_point(Bounds& bounds, const Vec3<Real>& point) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto value = static_cast<float>(point[axis]);
        bounds.lower[axis] = std::min(bounds.lower[axis], std::nextafter(value, -infinity<float>));
        bounds.upper[axis] = std::max(bounds.upper[axis], std::nextafter(value, infinity<float>));
    }
}

inline bool is_finite(const Bounds& bounds) {
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(bounds.lower[axis]) || !std::isfinite(bounds.upper[axis])) return false;
    return true;
}

inline Vec3d absolute(const Vec3d& v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// The bounds of several ranges in double, rounded outwards at the end. The bounds of all shapes
/// are rounded outwards.
class WidenedBounds {
  public:
    /// Includes [center - extent, center + extent]. Both may have the error of a handful of
    /// roundings in double of numbers up to `magnitude`.
    void include(const Vec3d& center, const Vec3d& extent, const Vec3d& magnitude) {
        constexpr double slack = 0x1p-48; // twice the error, relative to the largest operand
        for (int axis = 0; axis < 3; ++axis) {
            const double reach = extent[axis] + slack * (extent[axis] + magnitude[axis]);
            lower_[axis] = std::min(lower_[axis], center[axis] - reach);
            upper_[axis] = std::max(upper_[axis], center[axis] + reach);
        }
    }
    Bounds rounded() const;

  private:
    Vec3d lower_{std::numeric_limits<double>::infinity()};
    Vec3d upper_{-std::numeric_limits<double>::infinity()};
};
/// Returns the WidenedBounds of one range.
Bounds bounds_around(const Vec3d& center, const Vec3d& extent, const Vec3d& magnitude);

/// Returns the bounds of the disc about base + at * axis, perpendicular to the axis.
Bounds disc_bounds(const Vec3d& base, const Vec3d& axis, double at, double radius);

} // namespace raylane::core
