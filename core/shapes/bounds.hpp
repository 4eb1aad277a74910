#pragma once

#include "core/shapes/shapes.hpp"

#include <algorithm>

namespace raylane::core {

/// An axis-aligned box, closed. Empty if lower > upper in any axis.
struct Bounds {
    Vec3f lower{std::numeric_limits<float>::infinity()};
    Vec3f upper{-std::numeric_limits<float>::infinity()};

    void include(const Bounds& other) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], other.lower[axis]);
            upper[axis] = std::max(upper[axis], other.upper[axis]);
        }
    }

    bool contains(const Vec3f& p) const {
        return lower.x <= p.x && p.x <= upper.x && lower.y <= p.y && p.y <= upper.y &&
               lower.z <= p.z && p.z <= upper.z;
    }

    /// Half of the surface area; 0 if empty. In double, where it cannot overflow.
    double half_area() const {
        const Vec3d size = convert<double>(upper) - convert<double>(lower);
        if (!(size.x >= 0.0 && size.y >= 0.0 && size.z >= 0.0)) return 0.0;
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

/// The smallest box about the shape, or a little more: rounded outwards, never inwards.
Bounds bounds_of(const Sphere& sphere);
Bounds bounds_of(const Disc& disc);
Bounds bounds_of(const Triangle& triangle);
Bounds bounds_of(const SmoothTriangle& triangle);
Bounds bounds_of(const Box& box);
Bounds bounds_of(const OpenCylinder& cylinder);
Bounds bounds_of(const CappedCylinder& cylinder);
Bounds bounds_of(const OpenCone& cone);
Bounds bounds_of(const CappedCone& cone);
Bounds bounds_of(const Quadric& quadric);

} // namespace raylane::core
