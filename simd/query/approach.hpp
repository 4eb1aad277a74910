#pragma once

#include "core/shapes/ray.hpp"
#include "simd/query/paths.hpp"
#include "simd/query/scene_data.hpp"

namespace raylane::simd {

/// Moves starts of rays further along, before rays are rounded. A float direction leads to a point
/// a few ulps of the distance beside the exact one. From a million scene sizes away, that point may
/// be anywhere in the scene. So rays that start far away are moved near the scene, but not past
/// anything that they may cross. A ray with a lower limit starts there. The t of a ray then counts
/// from its new start.
class Approach {
  public:
    explicit Approach(const SceneData& scene);

    void take_from(Arena& arena, std::size_t capacity);

    /// Finds how far along rays start (RoundedRays::before), if any of them starts further along.
    void find_starts(const RayColumns& from, RoundedRays& rays);

    core::Vec3d center() const { return center_; }
    /// Returns the largest distance from the center, along each axis, of the origins of rays that
    /// are not moved; < 0: no ray is moved from far away.
    double reach() const;

    /// True if any of the last rays starts further along.
    bool any() const { return before_ != nullptr; }
    /// True if any of them was moved from far away.
    bool is_from_afar() const { return is_from_afar_; }
    /// Returns the excess of t over the t of the rounded ray.
    double before(std::size_t lane) const { return any() ? before_[lane] : 0.0; }
    /// Returns each t minus that excess.
    const double* from_there(const double* t);

  private:
    bool are_far(const RayColumns& rays) const;
    double before_of(const core::Ray<double>& ray) const;

    const SceneData& scene_;
    core::Vec3d center_{};
    double radius_ = -1.0; ///< of all bounded shapes; < 0: no ray is moved from far away
    std::size_t count_ = 0;
    bool is_from_afar_ = false;
    const double* before_ = nullptr;
    double* room_ = nullptr;
    double* t_ = nullptr;
};

} // namespace raylane::simd
