#pragma once

#include "core/reference/closest.hpp"
#include "simd/query/search.hpp"
#include "simd/stream/streams.hpp"

namespace raylane::simd {

class ShapesByName;

/// Finds closest surface points, always exactly. For one thread.
class ClosestWorker {
  public:
    ClosestWorker(const SceneData& scene, const Tracing& tracing, const ShapesByName& shapes);

    /// `max_distance`: of each point; null: infinite. Returns the number of refused points: those
    /// with an infinite or NaN coordinate, or a limit that is NaN.
    template <class Real>
    std::size_t find(const PointStream<Real>& points, const double* max_distance,
                     const ClosestStream& closest);

  private:
    core::ClosestSearcher searcher_;
};

} // namespace raylane::simd
