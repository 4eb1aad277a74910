#pragma once

#include "simd/query/certifier.hpp"

namespace raylane::simd {

/// The two queries of the renderer, the library and the benchmarks: the first hits of rays, and
/// whether anything is in their way. All surfaces are visible from both sides.
///
/// With core::Precision::exact, results are those of real arithmetic. CandidateSearch bounds shapes
/// in float. Certifier solves the shape that may be nearest in double and, where that is not
/// certain, decides it.
///
/// Drawing: bench/drawings/stages.svg
class Query {
  public:
    Query(const SceneData& scene, const Tracing& tracing, Asked asked)
        : scene_(scene), tracing_(tracing), search_(scene, tracing),
          certifier_(scene, tracing, asked) {}

    /// Takes arrays for this many rays.
    void take_from(Arena& arena, std::size_t capacity);

    /// Finds the first hit of each ray. `coherence`: null if the rays have nothing in common.
    /// `t_limit` (one per ray, or null for infinity): hits beyond it may be omitted.
    void nearest(const Paths& paths, const Coherence* coherence, EngineCounters& counters,
                 const double* t_limit = nullptr);
    /// Returns the hits of the last rays.
    const Hits& hits() const { return hits_; }
    /// Returns true if, shortly behind the lane's hit, the ray certainly crosses no other surface:
    /// none within the error of the hit point in double. A ray that starts at the hit point in
    /// double then misses no surface. Returns false if the search's bounds, which depend on its
    /// order, leave that open.
    bool is_apart(const Paths& paths, std::size_t lane) const;
    /// Returns a bound on the distance of the lane's hit point in double from the exact one.
    double error_of_point(const Paths& paths, std::size_t lane) const;
    /// Returns true if the lane's hit was not certain at first. Otherwise its ray does not only
    /// touch the shape, as certified solvers leave touches in doubt.
    bool was_refined(std::size_t lane) const { return certifier_.was_refined(lane); }
    /// Returns lanes that meet several surfaces at one point, where only the reference tracer can
    /// go on. Their hits are the surface that comes first.
    std::span<const std::uint32_t> at_contacts() const { return certifier_.at_contacts(); }
    /// Returns the hit points that differ from the points to which the rays and their t in double
    /// lead.
    std::span<const HitPoint> points() const { return certifier_.points(); }

    /// Raises `state`, an Occlusion of each ray, if a surface may be in its way before a distance.
    /// nearest() decides doubtful rays.
    void occluded(const RayColumns& rays, const double* distance, std::uint8_t* state,
                  const Coherence* coherence, EngineCounters& counters);

  private:
    const SceneData& scene_;
    Tracing tracing_;
    CandidateSearch search_;
    Certifier certifier_;
    Hits hits_{};
    float* first_ = nullptr; // by lane, bounds that a search has found
    float* second_ = nullptr;
};

} // namespace raylane::simd
