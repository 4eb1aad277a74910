#pragma once

#include "core/scene/scene.hpp"
#include "simd/isa.hpp"
#include "simd/stream/shapes_by_name.hpp"
#include "simd/stream/streams.hpp"
#include "simd/tracing.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace raylane::simd {

class SceneData;
class StreamWorker;

/// Answers streams of rays about one scene, which must outlive it. May be called by any number of
/// threads at a time. The answer to a ray depends on the scene and that ray alone.
///
/// Of rays in float a crossing counts by its t as it is answered: the nearest float, but never 0 or
/// infinity; of rays in double by its true t. What its material's `visible` says cannot be seen
/// from there does not count. A ray with a component that is not in the range of RayStream, a
/// direction of 0 or a limit that is NaN hits nothing.
class StreamTracer {
  public:
    /// `threads`: 0 is default_threads(). `isa`: an available one; default: the best.
    explicit StreamTracer(const core::Scene& scene, int threads = 0, Isa isa = best_isa(),
                          core::Precision precision = core::Precision::exact);
    ~StreamTracer();

    /// The nearest crossing. Of several at the same t, one that is entered comes before one that is
    /// left, then the lower id.
    template <class Real>
    void nearest(const RayStream<Real>& rays, const HitStream& hits) const;

    /// 1 where there is any crossing, 0 elsewhere.
    template <class Real>
    void occluded(const RayStream<Real>& rays, std::uint8_t* occluded) const;

  private:
    class Lease;

    template <class Answer>
    void answer(std::size_t count, const Answer& answer) const;

    static constexpr std::size_t fewest = 1024; ///< rays that are worth a thread

    int threads_;
    std::unique_ptr<const SceneData> data_;
    Tracing tracing_;

    ShapesByName shapes_;

    // Workers that nobody uses now: their memory is made once.
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<StreamWorker>> idle_;
};

} // namespace raylane::simd
