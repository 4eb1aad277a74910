#include "simd/stream/stream_tracer.hpp"

#include "core/reference/require_shapes.hpp"
#include "simd/stream/point_worker.hpp"
#include "simd/stream/row_worker.hpp"
#include "simd/stream/worker.hpp"
#include "simd/threads/default_rounding.hpp"
#include "simd/threads/threads.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

namespace raylane::simd {

StreamTracer::StreamTracer(const core::Scene& scene, int threads, Isa isa,
                           core::Precision precision)
    : threads_(threads), data_(std::make_unique<const SceneData>(scene, Transmissive::blocks)),
      tracing_{&kernels_of(isa), scene.solids().any() || scene.copies() != nullptr
                                     ? core::Precision::exact
                                     : precision},
      shapes_(*data_) {}

StreamTracer::~StreamTracer() = default;

/// Splits `count` rays so that all threads get some of them.
StreamTracer::Parts StreamTracer::parts_of(std::size_t count) const {
    if (count <= fewest) return {count, 1};
    const int threads = threads_ > 0 ? threads_ : default_threads();
    const std::size_t share = count / (std::size_t{4} * static_cast<std::size_t>(threads));
    const std::size_t size = std::max(share / fewest * fewest, fewest);
    if (threads == 1 || count <= size) return {count, 1};
    return {size, (count + size - 1) / size};
}

/// Calls answer(worker, first, count) for ranges that together cover all rays. Each has a size of
/// parts_of(count), but for the last. Returns the sum of the results.
template <class Worker, class Answer>
std::size_t StreamTracer::answer(Pool<Worker>& workers, std::size_t count,
                                 const Answer& answer) const {
    if (count == 0) return 0;
    std::atomic<std::size_t> refused = 0;
    const DefaultRounding rounding;
    const auto make = [&] { return std::make_unique<Worker>(*data_, tracing_, shapes_); };
    const Parts parts = parts_of(count);
    const auto answer_part = [&](std::size_t number) {
        const typename Pool<Worker>::Lease worker(workers, make);
        const std::size_t first = number * parts.size;
        refused += answer(*worker, first, std::min(parts.size, count - first));
    };
    if (parts.count == 1)
        answer_part(0);
    else
        on_threads(threads_, [&] { parallel_for(parts.count, answer_part); });
    return refused;
}

/// Calls answer(worker, first, count, rows) for the same ranges, with separate rows for each, and
/// joins these. Returns the sum of the results.
template <class Worker, class AnyRows, class Answer>
std::size_t StreamTracer::answer_in_rows(Pool<Worker>& workers, std::size_t count, AnyRows& rows,
                                         const Answer& answer_some) const {
    rows = {};
    const Parts parts = parts_of(count);
    std::vector<AnyRows> found(parts.count);
    const std::size_t refused =
        answer(workers, count, [&](Worker& worker, std::size_t first, std::size_t size) {
            return answer_some(worker, first, size, found[first / parts.size]);
        });
    if (parts.count == 1) {
        rows = std::move(found[0]);
        return refused;
    }
    rows.first.reserve(count + 1);
    for (AnyRows& part : found) {
        const std::uint64_t before = rows.first.back();
        for (std::size_t i = 1; i < part.first.size(); ++i)
            rows.first.push_back(before + part.first[i]);
        for_each_column(rows, part, [](auto& column, auto& addition) {
            column.insert(column.end(), addition.begin(), addition.end());
            addition = {};
        });
    }
    return refused;
}

template <class Real>
std::size_t StreamTracer::nearest(const RayStream<Real>& rays, const HitStream& hits,
                                  const NormalStream& normals) const {
    return answer(workers_, rays.count,
                  [&](StreamWorker& worker, std::size_t first, std::size_t count) {
                      return worker.nearest(part_of(rays, first, count), part_of(hits, first),
                                            part_of(normals, first));
                  });
}

template <class Real>
std::size_t StreamTracer::occluded(const RayStream<Real>& rays, std::uint8_t* occluded) const {
    return answer(workers_, rays.count,
                  [&](StreamWorker& worker, std::size_t first, std::size_t count) {
                      return worker.occluded(part_of(rays, first, count), occluded + first);
                  });
}

template <class Real>
std::size_t StreamTracer::crossings(const RayStream<Real>& rays, const CrossingRequest& wanted,
                                    CrossingRows& rows, CrossingCounters& counters) const {
    if (wanted.most == 1 && tracing_.precision == core::Precision::exact)
        return answer_in_rows(
            workers_, rays.count, rows,
            [&](StreamWorker& worker, std::size_t first, std::size_t count, CrossingRows& part) {
                return worker.first_crossings(part_of(rays, first, count), wanted, part);
            });
    std::mutex mutex;
    return answer_in_rows(
        row_workers_, rays.count, rows,
        [&](RowWorker& worker, std::size_t first, std::size_t count, CrossingRows& part) {
            CrossingCounters counted;
            const std::size_t refused =
                worker.crossings(part_of(rays, first, count), wanted, part, counted);
            const std::lock_guard lock(mutex);
            counters += counted;
            return refused;
        });
}

template <class Real>
std::size_t StreamTracer::count_crossings(const RayStream<Real>& rays,
                                          std::uint64_t* counts) const {
    return answer(row_workers_, rays.count,
                  [&](RowWorker& worker, std::size_t first, std::size_t count) {
                      return worker.count_crossings(part_of(rays, first, count), counts + first);
                  });
}

template <class Real>
std::size_t StreamTracer::path_lengths(const RayStream<Real>& rays, core::Bodies bodies,
                                       LengthRows& rows) const {
    return answer_in_rows(
        row_workers_, rays.count, rows,
        [&](RowWorker& worker, std::size_t first, std::size_t count, LengthRows& part) {
            return worker.path_lengths(part_of(rays, first, count), bodies, part);
        });
}

template <class Real>
std::size_t StreamTracer::containing(const PointStream<Real>& points, SolidRows& rows) const {
    core::require_shapes(data_->scene(), "solids around points");
    return answer_in_rows(
        point_workers_, points.count, rows,
        [&](PointWorker& worker, std::size_t first, std::size_t count, SolidRows& part) {
            return worker.containing(part_of(points, first, count), part);
        });
}

template <class Real>
std::size_t StreamTracer::cells(const PointStream<Real>& points, const CellStream& cells) const {
    core::require_shapes(data_->scene(), "cells");
    return answer(point_workers_, points.count,
                  [&](PointWorker& worker, std::size_t first, std::size_t count) {
                      return worker.cells(part_of(points, first, count), part_of(cells, first));
                  });
}

template <class Real>
std::size_t StreamTracer::closest(const PointStream<Real>& points, const double* max_distance,
                                  const ClosestStream& closest) const {
    core::require_closest_points(data_->scene());
    return answer(point_workers_, points.count,
                  [&](PointWorker& worker, std::size_t first, std::size_t count) {
                      return worker.closest(part_of(points, first, count),
                                            from(max_distance, first), part_of(closest, first));
                  });
}

#define RAYLANE_INSTANTIATE(Real)                                                                  \
    template std::size_t StreamTracer::nearest(const RayStream<Real>&, const HitStream&,           \
                                               const NormalStream&) const;                         \
    template std::size_t StreamTracer::occluded(const RayStream<Real>&, std::uint8_t*) const;      \
    template std::size_t StreamTracer::crossings(const RayStream<Real>&, const CrossingRequest&,   \
                                                 CrossingRows&, CrossingCounters&) const;          \
    template std::size_t StreamTracer::count_crossings(const RayStream<Real>&, std::uint64_t*)     \
        const;                                                                                     \
    template std::size_t StreamTracer::path_lengths(const RayStream<Real>&, core::Bodies,          \
                                                    LengthRows&) const;                            \
    template std::size_t StreamTracer::containing(const PointStream<Real>&, SolidRows&) const;     \
    template std::size_t StreamTracer::cells(const PointStream<Real>&, const CellStream&) const;   \
    template std::size_t StreamTracer::closest(const PointStream<Real>&, const double*,            \
                                               const ClosestStream&) const;
RAYLANE_INSTANTIATE(float)
RAYLANE_INSTANTIATE(double)
#undef RAYLANE_INSTANTIATE

} // namespace raylane::simd
