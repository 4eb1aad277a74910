#pragma once

#include "core/numbers/vector.hpp"

#include <cstddef>
#include <vector>

namespace raylane::scenes {

/// A natural cubic spline through points at the parameters 0, 1, 2, ... Its second derivative is
/// continuous, and 0 at both ends.
class Spline {
  public:
    /// `points` must not be empty.
    explicit Spline(std::vector<core::Vec3d> points);

    struct Place {
        core::Vec3d at, first, second; ///< the point and its derivatives
    };
    /// Returns the place at `s`, in [0, number of points - 1].
    Place operator()(double s) const;

    std::size_t size() const { return points_.size(); }

  private:
    std::vector<core::Vec3d> points_;
    std::vector<core::Vec3d> curvatures_; // second derivatives at the points
};

} // namespace raylane::scenes
