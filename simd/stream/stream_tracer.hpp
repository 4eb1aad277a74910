#pragma once

#include "core/reference/path_lengths.hpp"
#include "core/scene/scene.hpp"
#include "simd/isa/isa.hpp"
#include "simd/query/tracing.hpp"
#include "simd/stream/pool.hpp"
#include "simd/stream/rows.hpp"
#include "simd/stream/shapes_by_name.hpp"
#include "simd/stream/streams.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace raylane::simd {

class PointWorker;
class RowWorker;
class SceneData;
class StreamWorker;
struct CrossingCounters;

/// Answers streams of rays in one scene, which must outlive it. Any number of threads may call it
/// at a time. The answer to a ray depends on the scene and that ray alone.
///
/// A crossing counts by its t as it is answered: the nearest float for rays in float, the nearest
/// double for rays in double, but never 0 or infinity. Sides that the material's `visible` hides do
/// not count. A ray is refused, and hits nothing, if a component is infinite or NaN, its direction
/// is 0, or a limit is NaN. Queries return the number of refused rays, or of points with such
/// coordinates. They throw InvalidStart if a ray cannot start on the shape that it names; the
/// answers are then incomplete.
class StreamTracer {
  public:
    /// `threads`: 0 is default_threads(). `isa`: must be available; default: the best.
    explicit StreamTracer(const core::Scene& scene, int threads = 0, Isa isa = best_isa(),
                          core::Precision precision = core::Precision::exact);
    ~StreamTracer();

    /// Finds the nearest crossing of each ray. At the same t, entering precedes leaving, then the
    /// lower id precedes.
    template <class Real>
    std::size_t nearest(const RayStream<Real>& rays, const HitStream& hits,
                        const NormalStream& normals = {}) const;

    /// Writes 1 where a ray has any crossing, otherwise 0.
    template <class Real>
    std::size_t occluded(const RayStream<Real>& rays, std::uint8_t* occluded) const;

    /// Finds all crossings of each ray in their order, or the first ones. Replaces `rows`.
    /// Crossings count as above. The triangle with the lowest id counts where triangles of one
    /// polygon meet at an edge. This function and the following ones are exact with every
    /// precision.
    template <class Real>
    std::size_t crossings(const RayStream<Real>& rays, const CrossingRequest& wanted,
                          CrossingRows& rows, CrossingCounters& counters) const;

    /// Stores the number of all crossings of each ray.
    template <class Real>
    std::size_t count_crossings(const RayStream<Real>& rays, std::uint64_t* counts) const;

    /// Computes how much of each ray, between its limits, is inside of each solid, or of each
    /// material's solids, taken together as one solid. Lengths are in the scene's unit, within an
    /// ulp. Sides that cannot be seen count.
    template <class Real>
    std::size_t path_lengths(const RayStream<Real>& rays, core::Bodies bodies,
                             LengthRows& rows) const;

    /// Finds the solids that contain each point.
    template <class Real>
    std::size_t containing(const PointStream<Real>& points, SolidRows& rows) const;
    /// Finds the cell of each point.
    template <class Real>
    std::size_t cells(const PointStream<Real>& points, const CellStream& cells) const;
    /// Finds the closest surface point of each point, within a distance, or null. Throws
    /// InvalidValue as core::require_closest_points().
    template <class Real>
    std::size_t closest(const PointStream<Real>& points, const double* max_distance,
                        const ClosestStream& closest) const;

  private:
    /// Split of a call among threads: `count` parts of `size` rays.
    struct Parts {
        std::size_t size, count;
    };
    Parts parts_of(std::size_t count) const;
    template <class Worker, class Answer>
    std::size_t answer(Pool<Worker>& workers, std::size_t count, const Answer& answer) const;
    template <class Worker, class AnyRows, class Answer>
    std::size_t answer_in_rows(Pool<Worker>& workers, std::size_t count, AnyRows& rows,
                               const Answer& answer) const;

    static constexpr std::size_t fewest = 1024; ///< rays that are worth a thread

    int threads_;
    std::unique_ptr<const SceneData> data_;
    Tracing tracing_;

    ShapesByName shapes_;

    mutable Pool<StreamWorker> workers_;
    mutable Pool<RowWorker> row_workers_;
    mutable Pool<PointWorker> point_workers_;
};

} // namespace raylane::simd
