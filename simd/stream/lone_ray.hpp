#pragma once

#include "core/reference/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::simd {

/// A single ray of a stream: in double, with the shapes that it leaves, and its limits as given.
struct LoneRay {
    core::Ray<double> ray;
    core::OriginSurfaces<double> origins;
    int exponent; ///< the caller's t is this ray's t times 2^exponent
    double t_min, t_max;
    bool by_floats; ///< the limits are compared with the float nearest to t
    double t_most;  ///< no crossing counts from here on

    core::LeavingRay leaving() const { return {ray, origins}; }

    /// Return a crossing's t for the caller.
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
    /// Returns true if a hit counts: it is visible and between the limits.
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
