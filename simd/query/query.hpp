#pragma once

#include "simd/query/certifier.hpp"

namespace raylane::simd {

/// The two questions that the renderer, the library and the benchmarks ask of rays: what they hit
/// first, and whether anything is in their way. All surfaces are seen from both sides.
///
/// With core::Precision::exact as real arithmetic would answer: in float, shapes are bounded
/// (CandidateSearch); in double, the one that may be nearest is solved; and where that is not
/// certain, it is decided (Certifier).
class Query {
  public:
    Query(const SceneData& scene, const Tracing& tracing, Asked asked)
        : scene_(scene), tracing_(tracing), search_(scene, tracing),
          certifier_(scene, tracing, asked) {}

    /// Arrays for this many rays.
    void take_from(Arena& arena, std::size_t capacity);

    /// `coherence` may be null: the rays have nothing in common. Hits behind `t_most` are of no
    /// interest: whether there is one or not, nothing may be found; null: all are.
    void nearest(const Paths& paths, const Coherence* coherence, EngineCounters& counters,
                 const double* t_most = nullptr);
    /// Hits of the last rays.
    const Hits& hits() const { return hits_; }
    /// True if nothing else is crossed as near behind the lane's hit as its point in double may be
    /// off: what starts there loses nothing.
    bool is_apart(const Paths& paths, std::size_t lane) const;
    /// Lanes that meet several surfaces at one point, where only the reference can go on. They have
    /// the one that comes first.
    std::span<const std::uint32_t> at_contacts() const { return certifier_.at_contacts(); }
    /// Hit points that rays and t in double do not lead to.
    std::span<const HitPoint> points() const { return certifier_.points(); }

    /// Raises state, an Occlusion of each ray, by what is in its way before a distance. What is
    /// doubtful is for nearest() to say.
    void occluded(const RayColumns& rays, const double* distance, std::uint8_t* state,
                  const Coherence* coherence, EngineCounters& counters);

  private:
    const SceneData& scene_;
    Tracing tracing_;
    CandidateSearch search_;
    Certifier certifier_;
    Hits hits_{};
    float* first_ = nullptr; // by lane, what a search has found
    float* second_ = nullptr;
};

} // namespace raylane::simd
