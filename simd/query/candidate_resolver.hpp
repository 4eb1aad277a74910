#pragma once

#include "core/reference/crossing_order.hpp"
#include "simd/query/hits.hpp"
#include "simd/query/search.hpp"

#include <span>
#include <vector>

namespace raylane::simd {

/// Decides hits that bounds in float, and the nearest candidates in double, have left in doubt. All
/// shapes that a ray may cross first are solved in double. Those still in doubt are solved again in
/// numbers that carry error bounds, in double and wider, and at last exactly. core::CrossingOrder
/// orders crossings that these bounds do not distinguish.
///
/// The numbers of a hit are the kernels' for that ray and that shape, whatever else was in doubt.
/// If another crossing is almost at the same point, they are as accurate as double can be.
class CandidateResolver {
  public:
    CandidateResolver(const SceneData& scene, const Tracing& tracing, Asked asked)
        : scene_(scene), tracing_(tracing), for_points_(asked == Asked::points) {}

    void take_from(Arena& arena);

    /// Returns true if the method has kernels for refinement.
    bool works() const { return tracing_.method().refine.refine != nullptr; }

    /// Decides `lanes`. `hits` holds the hits found so far, except for those that are `doubtful`.
    /// Moves lanes that meet several surfaces at one point to the front, and returns their number.
    /// Their hits are the surface that comes first.
    std::size_t refine(const Paths& paths, const CandidateSearch& search,
                       const std::uint8_t* doubtful, std::span<std::uint32_t> lanes,
                       const Hits& hits, EngineCounters& counters);

    /// Returns points of lanes that the last call has decided.
    std::span<const HitPoint> points() const { return points_; }

  private:
    /// A ray and its candidates: from `begin` up to the next ray's.
    struct Ray {
        std::uint32_t lane;
        std::uint32_t begin;
    };
    struct Listed {
        double lower; ///< bound of t
        std::uint32_t slot;
    };

    void list(const Paths& paths, const CandidateSearch& search, std::size_t lane, double limit,
              EngineCounters& counters);
    void list_too(std::uint32_t slot);
    void take(const CandidateList& list, double before);
    double end_of_first(const Paths& paths, std::size_t lane, EngineCounters& counters);
    double end_of_first(std::size_t begin, std::size_t end, EngineCounters& counters);
    void add(const Paths& paths, std::size_t lane, std::span<const Listed> candidates);
    void solve(std::size_t begin);
    std::size_t first_of_many(const Paths& paths, std::size_t lane, EngineCounters& counters);
    std::size_t first_of(std::size_t begin, std::size_t end, EngineCounters& counters);
    std::size_t first_of_close(std::size_t begin);
    void extend_close();
    void solve(std::size_t candidate, EngineCounters& counters);
    bool counts(std::size_t candidate, const core::Crossing<double>& crossing) const;
    core::Hit<double> hit_of(std::size_t candidate) const;
    void swap(std::size_t a, std::size_t b);
    void hand_over(std::size_t candidate, const Hits& hits, std::uint32_t lane);

    static constexpr std::size_t most = 512; ///< candidates at a time

    const SceneData& scene_;
    Tracing tracing_;
    bool for_points_;
    Paths paths_{}; ///< by candidate
    Hits hits_{};
    double* lower_ = nullptr;
    std::size_t count_ = 0;
    std::vector<Ray> rays_;

    std::vector<std::uint32_t> slots_; ///< that kernels list
    std::vector<float> bounds_;
    std::vector<Listed> listed_;     ///< of one ray, the nearest first
    std::vector<std::size_t> close_; ///< candidates that bounds do not distinguish from the first
    std::vector<core::SharpHit> sharp_; ///< their hits
    std::vector<double> wide_;          ///< their t
    std::vector<HitPoint> points_;
};

} // namespace raylane::simd
