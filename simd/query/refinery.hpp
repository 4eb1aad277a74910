#pragma once

#include "core/reference/crossing_order.hpp"
#include "simd/query/hits.hpp"
#include "simd/query/search.hpp"

#include <span>
#include <vector>

namespace raylane::simd {

/// Decides what rays hit that bounds in float, and the nearest of these in double, have left in
/// doubt: all that each may cross first is solved in double and, where that leaves a doubt, once
/// more with numbers that carry bounds, in double and wider, and at last exactly. What these bounds
/// do not tell apart core::CrossingOrder does. The numbers of a hit are those that kernels have for
/// that ray and that shape, whatever else was in doubt, unless something is all but at the same
/// point: then they are as good as double can have them.
class Refinery {
  public:
    Refinery(const SceneData& scene, const Tracing& tracing, Asked asked)
        : scene_(scene), tracing_(tracing), for_points_(asked == Asked::points) {}

    void take_from(Arena& arena);

    /// True if the method has kernels for it.
    bool works() const { return tracing_.method().refine.finish_again != nullptr; }

    /// Decides on `lanes`, for which hits has what has been found so far, but for those that are
    /// `doubtful`. Puts first, and counts, those that meet several surfaces at one point; they have
    /// the one that comes first.
    std::size_t refine(const Paths& paths, const CandidateSearch& search,
                       const std::uint8_t* doubtful, std::span<std::uint32_t> lanes,
                       const Hits& hits, EngineCounters& counters);

    /// Points of the lanes that the last call has decided on.
    std::span<const HitPoint> points() const { return points_; }

  private:
    /// A ray and its candidates: those from `begin` on, up to the next one's.
    struct Ray {
        std::uint32_t lane;
        std::uint32_t begin;
    };
    struct Listed {
        double lower; ///< of t
        std::uint32_t slot;
    };

    void list(const Paths& paths, const CandidateSearch& search, std::size_t lane, double limit,
              EngineCounters& counters);
    void list_too(std::uint32_t slot);
    void take(const CandidateList& list, double before);
    double end_of_first(const Paths& paths, std::size_t lane, EngineCounters& counters);
    double end_of_first(std::size_t begin, std::size_t end, EngineCounters& counters);
    void add(const Paths& paths, std::size_t lane, std::span<const Listed> candidates);
    void finish(std::size_t begin);
    std::size_t first_of_many(const Paths& paths, std::size_t lane, EngineCounters& counters);
    std::size_t first_of(std::size_t begin, std::size_t end, EngineCounters& counters);
    std::size_t first_of_close(std::size_t begin);
    void widen_close();
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
    std::vector<Listed> listed_;        ///< of one ray, the nearest first
    std::vector<std::size_t> close_;    ///< candidates that bounds do not tell from the first
    std::vector<core::SharpHit> sharp_; ///< their hits
    std::vector<double> wide_;          ///< their t
    std::vector<HitPoint> points_;
};

} // namespace raylane::simd
