#include "scenes/formats/structure/displacement.hpp"

#include <cmath>
#include <numbers>

namespace raylane::scenes {

using core::Vec3d;

namespace {

/// Returns the share of a normal distribution in space within a radius: the integral of
/// sqrt(2 / pi) r^2 exp(-r^2 / 2), as a power series. For radii up to 5 its error is below 1e-10.
double share_within(double radius) {
    double power = radius * radius * radius, sum = 0.0;
    for (int k = 0; k < 120; ++k) {
        sum += power / (2 * k + 3);
        power *= -radius * radius / (2.0 * (k + 1));
    }
    return std::sqrt(2.0 / std::numbers::pi) * sum;
}

/// Replaces a symmetric tensor's rows by its principal axes, found by Jacobi's rotations. Each axis
/// is as long as `times` the root of its eigenvalue. Returns false if an eigenvalue is not
/// positive.
bool to_axes(std::array<Vec3d, 3>& rows, double times) {
    std::array<Vec3d, 3> axes = {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}; // columns
    for (int sweep = 0; sweep < 32; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                auto& row_p = rows[static_cast<std::size_t>(p)];
                auto& row_q = rows[static_cast<std::size_t>(q)];
                const double off = row_p[q];
                if (off == 0.0) continue;
                const double theta = (row_q[q] - row_p[p]) / (2.0 * off);
                const double t = (theta >= 0.0 ? 1.0 : -1.0) /
                                 (std::abs(theta) + std::sqrt(theta * theta + 1.0));
                const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
                const Vec3d old_p = row_p, old_q = row_q;
                row_p = c * old_p - s * old_q;
                row_q = s * old_p + c * old_q;
                for (Vec3d& row : rows) {
                    const double at_p = row[p], at_q = row[q];
                    row[p] = c * at_p - s * at_q;
                    row[q] = s * at_p + c * at_q;
                }
                Vec3d& axis_p = axes[static_cast<std::size_t>(p)];
                Vec3d& axis_q = axes[static_cast<std::size_t>(q)];
                const Vec3d before = axis_p;
                axis_p = c * before - s * axis_q;
                axis_q = s * before + c * axis_q;
            }
    for (std::size_t k = 0; k < 3; ++k) {
        const double value = rows[k][static_cast<int>(k)];
        if (!(value > 1e-9)) return false;
        rows[k] = times * std::sqrt(value) * axes[k];
    }
    return true;
}

} // namespace

double deviations_of(double probability) {
    double least = 0.0, most = 5.0;
    for (int bit = 0; bit < 60; ++bit) {
        const double middle = 0.5 * (least + most);
        (share_within(middle) < probability ? least : most) = middle;
    }
    return 0.5 * (least + most);
}

std::optional<std::array<Vec3d, 3>> axes_of(const Anisotropy& displacement, double deviations) {
    const auto& u = displacement.u;
    std::array<Vec3d, 3> axes = {Vec3d(u[0], u[3], u[4]), Vec3d(u[3], u[1], u[5]),
                                 Vec3d(u[4], u[5], u[2])};
    if (!to_axes(axes, deviations)) return std::nullopt;
    return axes;
}

} // namespace raylane::scenes
