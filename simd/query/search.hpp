#pragma once

#include "simd/engine_counters.hpp"
#include "simd/query/approach.hpp"
#include "simd/tracing.hpp"

namespace raylane::simd {

/// The first of what finds a hit: by bounds in float, what rays may meet.
class CandidateSearch {
  public:
    CandidateSearch(const SceneData& scene, const Tracing& tracing)
        : scene_(scene), tracing_(tracing), approach_(scene) {}

    void take_from(Arena& arena, std::size_t capacity);

    /// Rounds rays, which are asked about from now on: brought near first, if they are far.
    void take(const RayColumns& rays);

    /// `coherence` may be null: the rays have nothing in common.
    void nearest(const Coherence* coherence, const Candidates& candidates,
                 EngineCounters& counters);
    /// Occlusion before some distances, which t_most says of the rounded rays: t_most() of them.
    void occluded(const Coherence* coherence, const Occlusions& occlusions,
                  EngineCounters& counters);
    float t_most(std::size_t lane, double distance) const {
        return static_cast<float>(distance - approach_.before(lane));
    }

    const RoundedRays& rounded() const { return rounded_; }
    const Pending& pending() const { return workspace_; }
    const Approach& approach() const { return approach_; }
    Approach& approach() { return approach_; }

  private:
    const TraceKernels& trace() const;

    /// What rays still have in common where they start further along.
    const Coherence* common(const Coherence* coherence);

    const SceneData& scene_;
    Tracing tracing_;
    Approach approach_;
    std::size_t count_ = 0;
    RoundedRays rounded_{};
    Coherence moved_{};
    Workspace workspace_{};
};

/// Workspace of kernels, for so many rays.
Workspace workspace_for(const SceneData& scene, Arena& arena, std::size_t capacity);

} // namespace raylane::simd
