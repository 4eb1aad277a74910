#pragma once

#include "core/reference/closest.hpp"
#include "core/reference/containing.hpp"
#include "simd/query/search.hpp"
#include "simd/stream/rows.hpp"
#include "simd/stream/streams.hpp"

#include <vector>

namespace raylane::simd {

class ShapesByName;

/// Answers points, always exactly. For one thread. Each query returns the number of refused points:
/// those with an infinite or NaN coordinate, or a limit that is NaN.
class PointWorker {
  public:
    PointWorker(const SceneData& scene, const Tracing& tracing, const ShapesByName& shapes);

    /// Appends to the rows.
    template <class Real>
    std::size_t containing(const PointStream<Real>& points, SolidRows& rows);
    /// Stores the cell of each point.
    template <class Real>
    std::size_t cells(const PointStream<Real>& points, const CellStream& cells);
    /// Stores the closest surface point. `max_distance`: of each point; null: infinite.
    template <class Real>
    std::size_t closest(const PointStream<Real>& points, const double* max_distance,
                        const ClosestStream& closest);

  private:
    template <class Real, class Visit>
    std::size_t for_each_point(const PointStream<Real>& points, const Visit& visit);

    const core::Scene& scene_;
    core::PointSearcher solids_;
    core::ClosestSearcher surfaces_;
    std::vector<core::Containing> containing_; // one point
};

} // namespace raylane::simd
