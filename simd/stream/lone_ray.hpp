#pragma once

#include "core/reference/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::simd {

/// A ray of a stream by itself: in double, with what it leaves, and its limits as they were given.
struct LoneRay {
    core::Ray<double> ray;
    core::OriginSurfaces<double> origins;
    int exponent; ///< the caller's t is ours times 2^exponent
    double t_min, t_max;
    bool by_floats; ///< these compare with the float nearest to t
    double t_most;  ///< no crossing counts from here on

    core::LeavingRay leaving() const { return {ray, origins}; }

    /// A crossing's t for the caller.
    float t_of(const core::Scene& scene, const core::Hit<double>& hit) const {
        return core::rounded_t(scene, leaving(), hit, exponent);
    }
    double double_t_of(const core::Scene& scene, const core::Hit<double>& hit) const {
        return as_answered(core::nearest_double_t(scene, leaving(), hit));
    }
    double as_answered(double t) const {
        return std::clamp(std::ldexp(t, exponent), std::numeric_limits<double>::denorm_min(),
                          std::numeric_limits<double>::max());
    }
    /// True if it counts: between the limits, and where it can be seen.
    bool finds(const core::Scene& scene, const core::Hit<double>& hit) const {
        return scene.material_of(hit.shape).is_seen(hit.enters()) && is_behind_t_min(scene, hit) &&
               is_before_t_max(scene, hit);
    }
    bool is_before_t_max(const core::Scene& scene, const core::Hit<double>& hit) const {
        if (t_most == std::numeric_limits<double>::infinity()) return true;
        return by_floats ? static_cast<double>(t_of(scene, hit)) <= t_max
                         : compare_t(scene, hit, t_max) <= 0;
    }

  private:
    bool is_behind_t_min(const core::Scene& scene, const core::Hit<double>& hit) const {
        if (!(t_min > 0.0)) return true;
        return by_floats ? static_cast<double>(t_of(scene, hit)) > t_min
                         : compare_t(scene, hit, t_min) > 0;
    }
    int compare_t(const core::Scene& scene, const core::Hit<double>& hit, double limit) const {
        return core::compare_t(scene, leaving(), hit, std::ldexp(limit, -exponent));
    }
};

} // namespace raylane::simd
