#pragma once

#include "core/numbers/vector.hpp"

namespace raylane::oracle {

/// A ball that contains a shape. Each shape's file defines
///   Ball ball_around(shape)
struct Ball {
    core::Vec3d center;
    double radius;
};

inline double length_of(const core::Vec3d& v) {
    return core::length(v);
}

inline Ball ball(const core::Vec3d& center, double radius) {
    constexpr double slack = 1.0 + 0x1p-20; // far more than the rounding errors here
    return {center, radius * slack};
}

} // namespace raylane::oracle
