#include "calls.hpp"
#include "values.hpp"

using namespace raylane;
using namespace raylane::c;

namespace {

template <class Real, class CRays>
BasicRaySpan<Real> rays_from(const CRays* from) {
    const CRays& rays = checked("rays", from);
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
BasicPointSpan<Real> points_from(const CPoints* from) {
    const CPoints& points = checked("points", from);
    const std::size_t n = points.count;
    return {span_of("x", points.x, n), span_of("y", points.y, n), span_of("z", points.z, n)};
}

template <class Statistics, class CRays>
void store(const Statistics& statistics, const CRays* rays) {
    if (rays->refused != nullptr) *rays->refused = statistics.refused;
}

template <class Real, class CRays>
raylane_status intersect(const raylane_tracer* tracer, const CRays* rays,
                         const raylane_hits* hits) noexcept {
    return guarded([&] {
        const BasicRaySpan<Real> asked = rays_from<Real>(rays);
        const raylane_hits& to = checked("hits", hits);
        const std::size_t n = rays->count;
        QueryStatistics statistics;
        checked("tracer", tracer)
            .tracer.intersect(
                asked,
                HitSpan{span_of(to.t, n), span_of(to.normal_x, n), span_of(to.normal_y, n),
                        span_of(to.normal_z, n), span_of(to.shape_id, n), span_of(to.entering, n),
                        span_of(to.face, n), span_of(to.t_double, n),
                        span_of(to.normal_double_x, n), span_of(to.normal_double_y, n),
                        span_of(to.normal_double_z, n)},
                &statistics);
        store(statistics, rays);
    });
}

template <class Real, class CRays>
raylane_status occluded(const raylane_tracer* tracer, const CRays* rays,
                        std::uint8_t* result) noexcept {
    return guarded([&] {
        const BasicRaySpan<Real> asked = rays_from<Real>(rays);
        QueryStatistics statistics;
        checked("tracer", tracer)
            .tracer.occluded(asked, span_of("occluded", result, rays->count), &statistics);
        store(statistics, rays);
    });
}

/// Makes the rows that query(tracer, asked, rows, statistics) fills for rays or points.
template <class AnyRows, class Statistics, class Asked, class From, class Query>
raylane_status rows_of(const raylane_tracer* tracer, const From* from,
                       Asked (*convert)(const From*), raylane_rows** rows,
                       const Query& query) noexcept {
    return handle_of("rows", rows, [&] {
        const Asked asked = convert(from);
        AnyRows found;
        Statistics statistics;
        query(checked("tracer", tracer).tracer, asked, found, statistics);
        store(statistics, from);
        return found;
    });
}

template <class Real, class CRays>
raylane_status crossings(const raylane_tracer* tracer, const CRays* rays, std::size_t most,
                         int normals, raylane_rows** rows) noexcept {
    return rows_of<CrossingRows, CrossingStatistics>(
        tracer, rays, rays_from<Real, CRays>, rows,
        [&](const Tracer& of, const auto& asked, auto& found, auto& statistics) {
            of.crossings(asked, found, {most, normals != 0}, &statistics);
        });
}

template <class Real, class CPoints>
raylane_status contains(const raylane_tracer* tracer, const CPoints* points,
                        raylane_rows** rows) noexcept {
    return rows_of<SolidRows, QueryStatistics>(
        tracer, points, points_from<Real, CPoints>, rows,
        [](const Tracer& of, const auto& asked, auto& found, auto& statistics) {
            of.contains(asked, found, &statistics);
        });
}

template <class Real, class CRays>
raylane_status path_lengths(const raylane_tracer* tracer, const CRays* rays,
                            raylane_rows** rows) noexcept {
    return rows_of<LengthRows, QueryStatistics>(
        tracer, rays, rays_from<Real, CRays>, rows,
        [](const Tracer& of, const auto& asked, auto& found, auto& statistics) {
            of.path_lengths(asked, found, &statistics);
        });
}

template <class Real, class CRays>
raylane_status count_crossings(const raylane_tracer* tracer, const CRays* rays,
                               std::uint64_t* counts) noexcept {
    return guarded([&] {
        const BasicRaySpan<Real> asked = rays_from<Real>(rays);
        QueryStatistics statistics;
        checked("tracer", tracer)
            .tracer.count_crossings(asked, span_of("counts", counts, rays->count), &statistics);
        store(statistics, rays);
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
    return intersect<float>(tracer, rays, hits);
}

raylane_status raylane_intersect_doubles(const raylane_tracer* tracer,
                                         const raylane_double_rays* rays,
                                         const raylane_hits* hits) {
    return intersect<double>(tracer, rays, hits);
}

raylane_status raylane_occluded(const raylane_tracer* tracer, const raylane_rays* rays,
                                uint8_t* result) {
    return occluded<float>(tracer, rays, result);
}

raylane_status raylane_occluded_doubles(const raylane_tracer* tracer,
                                        const raylane_double_rays* rays, uint8_t* result) {
    return occluded<double>(tracer, rays, result);
}

raylane_status raylane_crossings(const raylane_tracer* tracer, const raylane_rays* rays,
                                 size_t most, int normals, raylane_rows** rows) {
    return crossings<float>(tracer, rays, most, normals, rows);
}

raylane_status raylane_crossings_doubles(const raylane_tracer* tracer,
                                         const raylane_double_rays* rays, size_t most, int normals,
                                         raylane_rows** rows) {
    return crossings<double>(tracer, rays, most, normals, rows);
}

raylane_status raylane_contains(const raylane_tracer* tracer, const raylane_points* points,
                                raylane_rows** rows) {
    return contains<float>(tracer, points, rows);
}

raylane_status raylane_contains_doubles(const raylane_tracer* tracer,
                                        const raylane_double_points* points, raylane_rows** rows) {
    return contains<double>(tracer, points, rows);
}

raylane_status raylane_path_lengths(const raylane_tracer* tracer, const raylane_rays* rays,
                                    raylane_rows** rows) {
    return path_lengths<float>(tracer, rays, rows);
}

raylane_status raylane_path_lengths_doubles(const raylane_tracer* tracer,
                                            const raylane_double_rays* rays, raylane_rows** rows) {
    return path_lengths<double>(tracer, rays, rows);
}

raylane_status raylane_count_crossings(const raylane_tracer* tracer, const raylane_rays* rays,
                                       std::uint64_t* counts) {
    return count_crossings<float>(tracer, rays, counts);
}

raylane_status raylane_count_crossings_doubles(const raylane_tracer* tracer,
                                               const raylane_double_rays* rays,
                                               std::uint64_t* counts) {
    return count_crossings<double>(tracer, rays, counts);
}
