#include "calls.hpp"
#include "values.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <type_traits>
#include <utility>

using namespace raylane;
using namespace raylane::c;

namespace {

template <class Real, class CRays>
BasicRaySpan<Real> rays_from(const CRays& rays) {
    const std::size_t n = rays.count;
    return {span_of("origin_x", rays.origin_x, n),
            span_of("origin_y", rays.origin_y, n),
            span_of("origin_z", rays.origin_z, n),
            span_of("direction_x", rays.direction_x, n),
            span_of("direction_y", rays.direction_y, n),
            span_of("direction_z", rays.direction_z, n),
            span_of(rays.t_min, n),
            span_of(rays.t_max, n),
            span_of(rays.origin_shape, n),
            span_of(rays.origin_face, n),
            span_of(rays.origin_inward, n)};
}

template <class Real, class CPoints>
BasicPointSpan<Real> points_from(const CPoints& points) {
    const std::size_t n = points.count;
    return {span_of("x", points.x, n), span_of("y", points.y, n), span_of("z", points.z, n)};
}

RaySpan span_from(const raylane_rays* rays) {
    return rays_from<float>(checked("rays", rays));
}
DoubleRaySpan span_from(const raylane_double_rays* rays) {
    return rays_from<double>(checked("rays", rays));
}
PointSpan span_from(const raylane_points* points) {
    return points_from<float>(checked("points", points));
}
DoublePointSpan span_from(const raylane_double_points* points) {
    return points_from<double>(checked("points", points));
}

HitSpan hits_from(const raylane_hits* from, std::size_t n) {
    const raylane_hits& hits = checked("hits", from);
    return {span_of(hits.t, n),
            span_of(hits.normal_x, n),
            span_of(hits.normal_y, n),
            span_of(hits.normal_z, n),
            span_of(hits.shape_id, n),
            span_of(hits.entering, n),
            span_of(hits.face, n),
            span_of(hits.t_double, n),
            span_of(hits.normal_double_x, n),
            span_of(hits.normal_double_y, n),
            span_of(hits.normal_double_z, n)};
}

/// Calls query(tracer, asked, count, &statistics) for rays or points, and stores how many of them
/// are refused.
template <class Statistics = QueryStatistics, class From, class Query>
raylane_status answered(const raylane_tracer* tracer, const From* from,
                        const Query& query) noexcept {
    return guarded([&] {
        const auto asked = span_from(from);
        Statistics statistics;
        query(checked("tracer", tracer).tracer, asked, from->count, &statistics);
        if (from->refused != nullptr) *from->refused = statistics.refused;
    });
}

template <class CRays>
raylane_status intersect(const raylane_tracer* tracer, const CRays* rays,
                         const raylane_hits* hits) noexcept {
    return answered(
        tracer, rays,
        [&](const Tracer& asked_tracer, const auto& asked, std::size_t n, auto* statistics) {
            asked_tracer.intersect(asked, hits_from(hits, n), statistics);
        });
}

template <class CRays>
raylane_status occluded(const raylane_tracer* tracer, const CRays* rays,
                        std::uint8_t* result) noexcept {
    return answered(
        tracer, rays,
        [&](const Tracer& asked_tracer, const auto& asked, std::size_t n, auto* statistics) {
            asked_tracer.occluded(asked, span_of("occluded", result, n), statistics);
        });
}

template <class CRays>
raylane_status count_crossings(const raylane_tracer* tracer, const CRays* rays,
                               std::uint64_t* counts) noexcept {
    return answered(
        tracer, rays,
        [&](const Tracer& asked_tracer, const auto& asked, std::size_t n, auto* statistics) {
            asked_tracer.count_crossings(asked, span_of("counts", counts, n), statistics);
        });
}

template <class CPoints>
raylane_status cells(const raylane_tracer* tracer, const CPoints* points,
                     const raylane_cell_columns* columns) noexcept {
    return answered(
        tracer, points,
        [&](const Tracer& asked_tracer, const auto& asked, std::size_t n, auto* statistics) {
            const raylane_cell_columns& to = checked("cells", columns);
            asked_tracer.cells(
                asked,
                {span_of(to.shape_id, n), span_of(to.material, n), span_of(to.on_surface, n)},
                statistics);
        });
}

template <class CPoints>
raylane_status find_closest(const raylane_tracer* tracer, const CPoints* points,
                            const double* max_distance,
                            const raylane_closest_points* closest) noexcept {
    return answered(
        tracer, points,
        [&](const Tracer& asked_tracer, const auto& asked, std::size_t n, auto* statistics) {
            const raylane_closest_points& to = checked("closest", closest);
            asked_tracer.closest(asked,
                                 {span_of(to.distance, n), span_of(to.point_x, n),
                                  span_of(to.point_y, n), span_of(to.point_z, n),
                                  span_of(to.shape_id, n), span_of(to.face, n)},
                                 span_of(max_distance, n), statistics);
        });
}

/// Makes the rows that query(tracer, asked, rows, &statistics) fills for rays or points.
template <class Rows, class Statistics, class From, class Query>
raylane_status rows_of(const raylane_tracer* tracer, const From* from, raylane_rows** rows,
                       const Query& query) noexcept {
    return handle_of("rows", rows, [&] {
        raylane_rows made;
        const auto asked = span_from(from);
        Statistics statistics;
        query(checked("tracer", tracer).tracer, asked, made.rows.emplace<Rows>(), &statistics);
        if constexpr (std::is_same_v<Statistics, CrossingStatistics>)
            made.statistics = std::bit_cast<raylane_crossing_statistics>(statistics);
        else
            made.statistics.refused = statistics.refused;
        if (from->refused != nullptr) *from->refused = statistics.refused;
        return made;
    });
}

/// The same for a function of Tracer.
template <class Rows, class Span>
using RowQuery = void (Tracer::*)(const Span&, Rows&, QueryStatistics*) const;

template <class Rows, class From>
raylane_status rows_by(RowQuery<Rows, decltype(span_from(std::declval<const From*>()))> query,
                       const raylane_tracer* tracer, const From* from,
                       raylane_rows** rows) noexcept {
    return rows_of<Rows, QueryStatistics>(
        tracer, from, rows,
        [&](const Tracer& asked_tracer, const auto& asked, Rows& found,
            QueryStatistics* statistics) { (asked_tracer.*query)(asked, found, statistics); });
}

template <class CRays>
raylane_status crossings(const raylane_tracer* tracer, const CRays* rays, std::size_t most,
                         int normals, raylane_rows** rows) noexcept {
    return rows_of<CrossingRows, CrossingStatistics>(
        tracer, rays, rows,
        [&](const Tracer& asked_tracer, const auto& asked, auto& found, auto* statistics) {
            if (normals < 0 || normals > (RAYLANE_NORMALS | RAYLANE_NORMALS_DOUBLE))
                throw InvalidValue("normals",
                                   "must be from 0 to 3, got " + std::to_string(normals));
            asked_tracer.crossings(
                asked, found,
                {most, (normals & RAYLANE_NORMALS) != 0, (normals & RAYLANE_NORMALS_DOUBLE) != 0},
                statistics);
        });
}

/// The columns x, y and z.
template <class Real>
using Columns = Real* const (&)[3];

template <class Real, class CRays>
raylane_status onward_from(const CRays* rays, const raylane_hits* hits,
                           Columns<const Real> directions, Columns<Real> origins,
                           std::uint8_t* inward) noexcept {
    return guarded([&] {
        const BasicRaySpan<Real> asked = span_from(rays);
        const std::size_t n = rays->count;
        const auto next = onward(
            asked, hits_from(hits, n), span_of("direction_x", directions[0], n),
            span_of("direction_y", directions[1], n), span_of("direction_z", directions[2], n));
        const auto give = [n](const char* name, auto* to, const auto& values) {
            std::copy(values.begin(), values.end(), span_of(name, to, n).begin());
        };
        give("origin_x", origins[0], next.origin_x);
        give("origin_y", origins[1], next.origin_y);
        give("origin_z", origins[2], next.origin_z);
        give("inward", inward, next.inward);
    });
}

} // namespace

raylane_status raylane_tracer_create(const raylane_scene* scene, int threads, int precision,
                                     raylane_tracer** tracer) {
    return guarded([&] {
        raylane_tracer*& to = checked("tracer", tracer);
        to = nullptr;
        to =
            new raylane_tracer{Tracer(checked("scene", scene).scene,
                                      {threads, enum_from_int<Precision>("precision", precision)})};
    });
}

void raylane_tracer_release(raylane_tracer* tracer) {
    delete tracer;
}

raylane_status raylane_intersect(const raylane_tracer* tracer, const raylane_rays* rays,
                                 const raylane_hits* hits) {
    return intersect(tracer, rays, hits);
}

raylane_status raylane_intersect_doubles(const raylane_tracer* tracer,
                                         const raylane_double_rays* rays,
                                         const raylane_hits* hits) {
    return intersect(tracer, rays, hits);
}

raylane_status raylane_occluded(const raylane_tracer* tracer, const raylane_rays* rays,
                                uint8_t* result) {
    return occluded(tracer, rays, result);
}

raylane_status raylane_occluded_doubles(const raylane_tracer* tracer,
                                        const raylane_double_rays* rays, uint8_t* result) {
    return occluded(tracer, rays, result);
}

raylane_status raylane_crossings(const raylane_tracer* tracer, const raylane_rays* rays,
                                 size_t most, int normals, raylane_rows** rows) {
    return crossings(tracer, rays, most, normals, rows);
}

raylane_status raylane_crossings_doubles(const raylane_tracer* tracer,
                                         const raylane_double_rays* rays, size_t most, int normals,
                                         raylane_rows** rows) {
    return crossings(tracer, rays, most, normals, rows);
}

raylane_status raylane_contains(const raylane_tracer* tracer, const raylane_points* points,
                                raylane_rows** rows) {
    return rows_by<SolidRows>(&Tracer::contains, tracer, points, rows);
}

raylane_status raylane_contains_doubles(const raylane_tracer* tracer,
                                        const raylane_double_points* points, raylane_rows** rows) {
    return rows_by<SolidRows>(&Tracer::contains, tracer, points, rows);
}

raylane_status raylane_path_lengths(const raylane_tracer* tracer, const raylane_rays* rays,
                                    raylane_rows** rows) {
    return rows_by<LengthRows>(&Tracer::path_lengths, tracer, rays, rows);
}

raylane_status raylane_path_lengths_doubles(const raylane_tracer* tracer,
                                            const raylane_double_rays* rays, raylane_rows** rows) {
    return rows_by<LengthRows>(&Tracer::path_lengths, tracer, rays, rows);
}

raylane_status raylane_count_crossings(const raylane_tracer* tracer, const raylane_rays* rays,
                                       std::uint64_t* counts) {
    return count_crossings(tracer, rays, counts);
}

raylane_status raylane_count_crossings_doubles(const raylane_tracer* tracer,
                                               const raylane_double_rays* rays,
                                               std::uint64_t* counts) {
    return count_crossings(tracer, rays, counts);
}

raylane_status raylane_solid_lengths(const raylane_tracer* tracer, const raylane_rays* rays,
                                     raylane_rows** rows) {
    return rows_by<SolidLengthRows>(&Tracer::solid_lengths, tracer, rays, rows);
}

raylane_status raylane_solid_lengths_doubles(const raylane_tracer* tracer,
                                             const raylane_double_rays* rays, raylane_rows** rows) {
    return rows_by<SolidLengthRows>(&Tracer::solid_lengths, tracer, rays, rows);
}

raylane_status raylane_cells(const raylane_tracer* tracer, const raylane_points* points,
                             const raylane_cell_columns* columns) {
    return cells(tracer, points, columns);
}

raylane_status raylane_cells_doubles(const raylane_tracer* tracer,
                                     const raylane_double_points* points,
                                     const raylane_cell_columns* columns) {
    return cells(tracer, points, columns);
}

raylane_status raylane_closest(const raylane_tracer* tracer, const raylane_points* points,
                               const double* max_distance, const raylane_closest_points* closest) {
    return find_closest(tracer, points, max_distance, closest);
}

raylane_status raylane_closest_doubles(const raylane_tracer* tracer,
                                       const raylane_double_points* points,
                                       const double* max_distance,
                                       const raylane_closest_points* closest) {
    return find_closest(tracer, points, max_distance, closest);
}

raylane_status raylane_onward(const raylane_rays* rays, const raylane_hits* hits,
                              const float* direction_x, const float* direction_y,
                              const float* direction_z, float* origin_x, float* origin_y,
                              float* origin_z, uint8_t* inward) {
    return onward_from<float>(rays, hits, {direction_x, direction_y, direction_z},
                              {origin_x, origin_y, origin_z}, inward);
}

raylane_status raylane_onward_doubles(const raylane_double_rays* rays, const raylane_hits* hits,
                                      const double* direction_x, const double* direction_y,
                                      const double* direction_z, double* origin_x, double* origin_y,
                                      double* origin_z, uint8_t* inward) {
    return onward_from<double>(rays, hits, {direction_x, direction_y, direction_z},
                               {origin_x, origin_y, origin_z}, inward);
}
