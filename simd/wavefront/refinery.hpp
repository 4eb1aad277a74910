#pragma once

#include "core/reference/counters.hpp"
#include "core/reference/crossing_order.hpp"
#include "simd/wavefront/approach.hpp"
#include "simd/wavefront/hits.hpp"
#include "simd/wavefront/scene_data.hpp"
#include "simd/wavefront/tracing.hpp"

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
    Refinery(const SceneData& scene, const Tracing& tracing) : scene_(scene), tracing_(tracing) {}

    /// For rays that `stand_for_others` or not (see Paths), of whose hits points and normals will
    /// be asked in double, or answers in float.
    void take_from(Arena& arena, bool stand_for_others, bool for_points);

    /// Whether there is anything to be had of it.
    bool works() const { return tracing_.method().refine.finish_again != nullptr; }

    /// What paths are to filters.
    struct Stream {
        const RoundedRays& rounded;
        const Approach& approach;
    };

    /// Decides on `lanes`, for which hits has what has been found so far, but for those that are
    /// `doubtful`. Puts first, and counts, those that meet several surfaces at one point; they have
    /// the one that comes first.
    std::size_t refine(const Paths& paths, const Stream& stream, const Pending& pending,
                       const std::uint8_t* doubtful, std::span<std::uint32_t> lanes,
                       const Hits& hits, core::Counters& counters);

    /// A hit point that the ray and its t in double do not lead to.
    struct Point {
        std::uint32_t lane;
        core::Vec3d point;
    };
    /// Of the lanes that the last call has decided on.
    std::span<const Point> points() const { return points_; }

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

    void list(const Paths& paths, const Stream& stream, const Pending& pending, std::size_t lane,
              double limit, core::Counters& counters);
    void take(const CandidateList& list, double before);
    double end_of_first(const Paths& paths, std::size_t lane, core::Counters& counters);
    double end_of_first(std::size_t begin, std::size_t end, core::Counters& counters);
    void add(const Paths& paths, std::size_t lane, std::span<const Listed> candidates);
    void finish(std::size_t begin);
    std::size_t first_of_many(const Paths& paths, std::size_t lane, core::Counters& counters);
    std::size_t first_of(std::size_t begin, std::size_t end, core::Counters& counters);
    std::size_t first_of_close(std::size_t begin);
    void widen_close();
    void solve(std::size_t candidate, core::Counters& counters);
    core::Hit<double> hit_of(std::size_t candidate) const;
    void swap(std::size_t a, std::size_t b);
    void hand_over(std::size_t candidate, const Hits& hits, std::uint32_t lane);

    static constexpr std::size_t most = 512; ///< candidates at a time

    const SceneData& scene_;
    Tracing tracing_;
    bool for_points_ = true;
    Paths paths_{}; ///< by candidate
    Hits hits_{};
    double* lower_ = nullptr;
    std::size_t count_ = 0;
    std::vector<Ray> rays_;

    std::vector<std::uint32_t> slots_; ///< what kernels list
    std::vector<float> bounds_;
    std::vector<Listed> listed_;        ///< of one ray, the nearest first
    std::vector<std::size_t> close_;    ///< candidates that bounds do not tell from the first
    std::vector<core::SharpHit> sharp_; ///< their hits
    std::vector<double> wide_;          ///< their t
    std::vector<Point> points_;
};

} // namespace raylane::simd
