#pragma once

#include "core/shapes/ray.hpp"
#include "simd/query/paths.hpp"
#include "simd/scene_data.hpp"

namespace raylane::simd {

/// Starts of rays further along, before they are rounded. A float direction leads to a point a few
/// ulps of the distance beside the one that is meant, which from a million sizes away is anywhere
/// in the scene: so rays that start far away are brought near it, no further than before all that
/// they may cross. And where a ray has a limit below, it starts there. Its t then counts from where
/// it has been brought.
class Approach {
  public:
    explicit Approach(const SceneData& scene);

    void take_from(Arena& arena, std::size_t capacity);

    /// Finds how far along rays start, RoundedRays::before, if any of them does.
    void find_starts(const RayColumns& from, RoundedRays& rays);

    /// True if any of the last rays starts further along.
    bool any() const { return before_ != nullptr; }
    /// True if any of them has been brought from far away.
    bool is_from_afar() const { return is_from_afar_; }
    /// Excess of t over the t of the rounded ray.
    double before(std::size_t lane) const { return any() ? before_[lane] : 0.0; }
    /// Each t less that.
    const double* from_there(const double* t);

  private:
    bool are_far(const RayColumns& rays) const;
    double before_of(const core::Ray<double>& ray) const;

    const SceneData& scene_;
    core::Vec3d center_{};
    double radius_ = -1.0; ///< of all that is bounded; < 0: no ray is brought anywhere
    std::size_t count_ = 0;
    bool is_from_afar_ = false;
    const double* before_ = nullptr;
    double* room_ = nullptr;
    double* t_ = nullptr;
};

} // namespace raylane::simd
