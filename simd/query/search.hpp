#pragma once

#include "simd/query/approach.hpp"
#include "simd/query/copy_search.hpp"
#include "simd/query/engine_counters.hpp"
#include "simd/query/tracing.hpp"

#include <memory>

namespace raylane::simd {

/// Returns a float that is not below the number that was rounded to `value`; 0 if `value` is
/// negative.
inline float rounded_up(float value) {
    return value < 0.0F ? 0.0F : (value < min_length ? min_length : value) * (1.0F + 0x1p-21F);
}

/// First step of the search for hits: finds shapes that rays may meet by bounds in float.
class CandidateSearch {
  public:
    CandidateSearch(const SceneData& scene, const Tracing& tracing);

    void take_from(Arena& arena, std::size_t capacity);

    /// Rounds rays for the following queries. Rays that start far away are moved near first.
    void take(const RayColumns& rays);

    /// `coherence`: null if the rays have nothing in common.
    void nearest(const Coherence* coherence, const Candidates& candidates,
                 EngineCounters& counters);
    /// Finds occlusion before distances. Occlusions::t_limit holds those of the rounded rays, as
    /// t_limit() returns them.
    /// `distance`: the limits before they are rounded.
    void occluded(const Coherence* coherence, const Occlusions& occlusions, const double* distance,
                  EngineCounters& counters);
    /// Lists all shapes that a lane's ray may cross before a limit; see
    /// RefineKernels::list_candidates.
    bool list(std::size_t lane, CandidateList& list, TraceCounters& counters) const;
    /// Adds all pairs of rays and shapes; see RefineKernels::list_all.
    void list_all(const float* t_limit, PairList& list) const;
    float t_limit(std::size_t lane, double distance) const {
        return static_cast<float>(distance - approach_.before(lane));
    }

    const RoundedRays& rounded() const { return rounded_; }
    const Approach& approach() const { return approach_; }
    Approach& approach() { return approach_; }

  private:
    const TraceKernels& trace() const;

    /// Returns the coherence that remains where rays start further along.
    const Coherence* common(const Coherence* coherence);

    const SceneData& scene_;
    Tracing tracing_;
    Approach approach_;
    std::size_t count_ = 0;
    RoundedRays rounded_{};
    Coherence moved_{};
    Workspace workspace_{};
    std::unique_ptr<CopySearch> copies_; // null if the scene has none
};

/// Takes memory of kernels for `capacity` rays.
Workspace workspace_for(const SceneData& scene, Arena& arena, std::size_t capacity);

} // namespace raylane::simd
