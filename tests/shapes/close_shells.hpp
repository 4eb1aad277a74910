#pragma once

#include "tests/support/placing.hpp"
#include "tests/support/random.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

/// A shape between two neighbours at a small gap: a skin outside of it, and another inside. All
/// coordinates are integers below 2^23 in size, so that gaps are exact, and stay exact wherever a
/// nest is placed. Radii are any floats.
namespace raylane::tests {

using core::Vec3d;
using ray_sets::Random;
using ray_sets::rounded;

struct CloseShells {
    AnyShape shape, outer, inner;
    /// Every ray that leaves `shape` outward meets `outer`.
    bool closed;
    /// Every ray that leaves `shape` inward meets `inner`.
    bool parted = false;
};

/// The smallest gap between coordinates. If a nest is far away, an ulp of the largest coordinate is
/// 1.
inline constexpr double min_gap = 4.0;

inline double ulp(float value) {
    return static_cast<double>(std::nextafter(value, 2 * value) - value);
}

/// Returns a gap between two radii: from 4 of their ulps to half of them.
inline float gap_of_radii(float radius, Random& r) {
    return rounded(r.log_uniform(4.0 * ulp(radius), 0.5 * static_cast<double>(radius)));
}

inline Vec3f whole(const Vec3d& v) {
    return rounded(glm::round(v));
}

/// Returns a step of integers, at least 4 across planes with this normal.
inline Vec3f step_across(const Vec3d& normal, double size, Random& r) {
    const Vec3d n = core::normalized(normal);
    while (true) {
        const Vec3f step = whole(n * r.log_uniform(min_gap, std::max(size, 8.0)));
        if (core::dot(n, core::convert<double>(step)) >= min_gap) return step;
    }
}

/// Returns the number of gaps that make up a length: 4 to 2^16.
inline float number_of_gaps(double length, double gap) {
    return rounded(std::clamp(std::round(length / gap), 4.0, 0x1p16));
}

/// Makes nests of one kind and of about a given size.
template <class Shape>
struct NestOf;

} // namespace raylane::tests
