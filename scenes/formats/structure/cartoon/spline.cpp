#include "scenes/formats/structure/cartoon/spline.hpp"

#include <algorithm>
#include <utility>

namespace raylane::scenes {

using core::Vec3d;

/// Continuity of the first derivative at point i gives m[i-1] + 4 m[i] + m[i+1] = 6 (p[i-1] - 2
/// p[i] + p[i+1]) for the second derivatives m. Thomas' algorithm solves this.
Spline::Spline(std::vector<Vec3d> points)
    : points_(std::move(points)), curvatures_(points_.size(), Vec3d(0.0)) {
    const std::size_t count = points_.size();
    if (count < 3) return;
    std::vector<double> above(count, 0.0); // coefficient of the next unknown, after elimination
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const Vec3d bend = 6.0 * (points_[i - 1] - 2.0 * points_[i] + points_[i + 1]);
        const double pivot = 4.0 - above[i - 1];
        above[i] = 1.0 / pivot;
        curvatures_[i] = 1.0 / pivot * (bend - curvatures_[i - 1]);
    }
    for (std::size_t i = count - 2; i > 0; --i)
        curvatures_[i] = curvatures_[i] - above[i] * curvatures_[i + 1];
}

Spline::Place Spline::operator()(double s) const {
    if (points_.size() == 1) return {points_[0], Vec3d(0.0), Vec3d(0.0)};
    const auto i = std::min(static_cast<std::size_t>(s), points_.size() - 2);
    const double v = s - static_cast<double>(i), u = 1.0 - v;
    const Vec3d &p = points_[i], &q = points_[i + 1];
    const Vec3d &m = curvatures_[i], &n = curvatures_[i + 1];
    return {u * p + v * q + (u * u * u - u) / 6.0 * m + (v * v * v - v) / 6.0 * n,
            q - p + (1.0 - 3.0 * u * u) / 6.0 * m + (3.0 * v * v - 1.0) / 6.0 * n, u * m + v * n};
}

} // namespace raylane::scenes
