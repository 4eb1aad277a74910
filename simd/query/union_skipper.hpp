#pragma once

#include "core/reference/solid_surfaces.hpp"
#include "simd/query/pair_crossings.hpp"

#include <span>
#include <vector>

namespace raylane::simd {

/// Moves rays inside of a union of many parts past the crossings at which they stay inside. All
/// crossings of a ray with the union are found at once, with bounds, not by one search after the
/// other. For use by one thread.
class UnionSkipper {
  public:
    UnionSkipper(const SceneData& scene, const Tracing& tracing);

    void take_from(Arena& arena, std::size_t capacity);

    /// Moves rays to points between a crossing that is certainly hidden and the first one that may
    /// be visible, with a sure distance to both. Rays without such a point stay. `ways`: of each
    /// ray. `passed`: the lengths of the ways behind the rays.
    void skip(const Paths& paths, std::span<core::WayInUnion> ways, double* passed);

  private:
    struct Event {
        double low, high; ///< bounds of t
        bool is_part;     ///< of the union
        bool entering;
    };

    bool is_inside(const core::WayInUnion& way) const;
    void skip_some(const Paths& paths, std::size_t begin, std::size_t end,
                   std::span<core::WayInUnion> ways, double* passed);
    bool list_pairs(std::size_t begin, std::size_t end, std::span<const core::WayInUnion> ways);
    bool find_events(const Paths& paths, std::size_t lane, const core::WayInUnion& way);
    bool add_return(const Paths& paths, std::size_t lane, const core::WayInUnion& way);
    void add(double t, double error, bool entering, core::ShapeId shape,
             const core::WayInUnion& way);
    double find_place(const Paths& paths, std::size_t lane, core::WayInUnion& way);

    const SceneData& scene_;
    Tracing tracing_;
    CandidateSearch search_;
    float* t_limit_ = nullptr;
    PairCrossings pairs_;
    std::vector<Event> events_; ///< of a ray
};

} // namespace raylane::simd
