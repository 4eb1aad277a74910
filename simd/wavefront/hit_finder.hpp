#pragma once

#include "core/reference/tracer.hpp"
#include "simd/wavefront/approach.hpp"
#include "simd/wavefront/as_core.hpp"
#include "simd/wavefront/hits.hpp"
#include "simd/wavefront/refinery.hpp"
#include "simd/wavefront/tie_breaker.hpp"

#include <memory>
#include <optional>
#include <span>

namespace raylane::simd {

/// Finds the first surfaces that rays hit. With core::Precision::exact as real arithmetic would: in
/// float, shapes are bounded; in double, the one that may be nearest is solved; and where that is
/// not certain, a Refinery decides. In float alone nothing is uncertain, and a TieBreaker decides
/// where t is the same; doubles without bounds the reference compares.
class HitFinder {
  public:
    /// For a picture: hits are as good as points and normals in double have to be. Surfaces that
    /// cannot be seen from where the rays come are none.
    HitFinder(const SceneData& scene, const Tracing& tracing,
              core::ReferenceTracer<double>& reference)
        : HitFinder(scene, tracing, &reference, scene.one_sided()) {}
    /// For rays that stand for others (Paths), of whose hits floats are wanted; hits have
    /// hit_normal_doubtful. All surfaces are seen. What doubles without bounds leave in doubt is
    /// left open.
    HitFinder(const SceneData& scene, const Tracing& tracing)
        : HitFinder(scene, tracing, nullptr, false) {}

    /// Arrays for this many rays.
    void take_from(Arena& arena, std::size_t capacity);

    /// `bundle` may be null: the rays have nothing in common.
    void find(const Paths& paths, const Bundle* bundle, core::Counters& counters);

    const Hits& hits() const { return hits_; }
    /// Lanes that are left open: those which meet several surfaces at one point, where only the
    /// reference can go on. They have the one that comes first.
    std::span<const std::uint32_t> left_open() const { return {open_, open_count_}; }
    /// Hit points that rays and t in double do not lead to.
    std::span<const Refinery::Point> points() const { return points_; }
    core::Vec3d point_of(const Paths& paths, std::size_t lane) const;

  private:
    HitFinder(const SceneData& scene, const Tracing& tracing,
              core::ReferenceTracer<double>* reference, bool looks_through);

    void start(const Paths& paths);
    void find_own_exits(const Paths& paths);
    void break_ties(const Paths& paths);
    void ask_reference(const Paths& paths, core::Counters& counters);
    void look_through(const Paths& paths, const Bundle* bundle, core::Counters& counters);
    bool is_visible(const Hits& hits, std::size_t lane) const;
    const Refinery::Point* known_point(std::size_t lane) const;
    void move_on(const Hits& hits, std::size_t lane, std::size_t to);
    void settle(const Paths& paths, std::size_t lane, const core::Hit<double>& hit);
    void finish(Found found) const;

    const SceneData& scene_;
    Tracing tracing_;
    core::ReferenceTracer<double>* reference_; // may be null
    std::optional<TieBreaker> tie_breaker_;
    Refinery refinery_;
    bool for_points_;

    Approach approach_;
    RoundedRays rounded_{};
    Candidates candidates_{};
    Workspace workspace_{};
    Hits hits_{};
    std::uint8_t* doubtful_ = nullptr;
    std::uint32_t* open_ = nullptr;
    std::size_t open_count_ = 0;

    // Some of the rays, put together.
    Paths gathered_{};
    Hits gathered_hits_{};
    std::uint32_t* lanes_ = nullptr;
    std::size_t lane_count_ = 0;
    std::vector<Refinery::Point> points_;

    // Where surfaces are visible from one side only, what is behind the other: found as if all
    // were visible.
    std::unique_ptr<HitFinder> onward_;
    Paths onward_paths_{}; // sample: the lane
    double* passed_ = nullptr;
};

/// Arrays for rounded rays, but what they leave.
void take_rounded(Arena& arena, RoundedRays& rays, std::size_t capacity);
/// What kernels work in, for streams of so many rays.
Workspace workspace_for(const SceneData& scene, Arena& arena, std::size_t capacity);

} // namespace raylane::simd
