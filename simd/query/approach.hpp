#pragma once

#include "core/shapes/ray.hpp"
#include "simd/query/paths.hpp"
#include "simd/scene_data.hpp"

namespace raylane::simd {

/// Brings rays that start far away near the scene before they are rounded: a float direction leads
/// to a point a few ulps of the distance beside the one that is meant, which from a million sizes
/// away is anywhere in the scene. Such a ray's t then counts from where it has been brought, no
/// further than before all that it may cross.
class Approach {
  public:
    explicit Approach(const SceneData& scene);

    void take_from(Arena& arena, std::size_t capacity);

    /// Has `count` rays, before they are rounded, rounded from where they are near, if any of them
    /// is far. Their slack is to be widened then.
    void bring_near(std::size_t count, RoundedRays& rays);
    void widen(const RoundedRays& rays) const;

    /// True if any of the last rays is far.
    bool any() const { return any_; }
    /// Excess of t over the t of the rounded ray.
    double before(std::size_t lane) const { return any_ ? before_[lane] : 0.0; }
    /// Each t less that.
    const double* from_there(const double* t);

  private:
    bool are_far(std::size_t count, const RoundedRays& rays) const;
    double before_of(const core::Ray<double>& ray) const;

    const SceneData& scene_;
    core::Vec3d center_{};
    double radius_ = -1.0; ///< of all that is bounded; < 0: no ray is brought anywhere
    std::size_t count_ = 0;
    bool any_ = false;
    double* origin_[3] = {};
    double* before_ = nullptr;
    double* off_ = nullptr; ///< the error of a new origin
    double* t_ = nullptr;
};

} // namespace raylane::simd
