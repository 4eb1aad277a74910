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

template <class CRays>
void store(const QueryStatistics& statistics, const CRays* rays) {
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
            .tracer.intersect(asked,
                              HitSpan{span_of(to.t, n), span_of(to.normal_x, n),
                                      span_of(to.normal_y, n), span_of(to.normal_z, n),
                                      span_of(to.shape, n), span_of(to.entering, n),
                                      span_of(to.face, n), span_of(to.t_double, n)},
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
