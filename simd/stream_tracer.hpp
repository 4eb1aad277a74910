#pragma once

#include "core/scene/scene.hpp"
#include "simd/isa.hpp"
#include "simd/stream/pool.hpp"
#include "simd/stream/rows.hpp"
#include "simd/stream/shapes_by_name.hpp"
#include "simd/stream/streams.hpp"
#include "simd/tracing.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace raylane::simd {

class RowWorker;
class SceneData;
class StreamWorker;
struct CrossingCounters;
struct CrossingRequest;

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

    /// All crossings in their order, or the first ones. Rows are replaced. What counts, does so as
    /// above; of triangles of one polygon that meet at an edge, the one with the lower id. Whatever
    /// the precision, this and the following are exact.
    template <class Real>
    void crossings(const RayStream<Real>& rays, const CrossingRequest& wanted, CrossingRows& rows,
                   CrossingCounters& counters) const;

    /// How much of each ray, between its limits, is inside of each material's solids: as if these
    /// were one solid, in the scene's unit, within an ulp. Sides that cannot be seen count.
    template <class Real>
    void path_lengths(const RayStream<Real>& rays, LengthRows& rows) const;

    /// The solids that points are in.
    template <class Real>
    void containing(const PointStream<Real>& points, SolidRows& rows) const;

  private:
    /// How a call is shared out among threads: so many parts, each of so many.
    struct Parts {
        std::size_t size, count;
    };
    Parts parts_of(std::size_t count) const;
    template <class Answer>
    void answer(std::size_t count, const Answer& answer) const;
    template <class AnyRows, class Answer>
    void answer_in_rows(std::size_t count, AnyRows& rows, const Answer& answer) const;

    static constexpr std::size_t fewest = 1024; ///< rays that are worth a thread

    int threads_;
    std::unique_ptr<const SceneData> data_;
    Tracing tracing_;

    ShapesByName shapes_;

    mutable Pool<StreamWorker> workers_;
    mutable Pool<RowWorker> row_workers_;
};

} // namespace raylane::simd
