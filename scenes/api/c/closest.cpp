#include "calls.hpp"

using namespace raylane;
using namespace raylane::c;

namespace {

template <class Real, class CPoints>
raylane_status find_closest(const raylane_tracer* tracer, const CPoints* from,
                            const double* max_distance,
                            const raylane_closest_points* closest) noexcept {
    return guarded([&] {
        const CPoints& points = checked("points", from);
        const raylane_closest_points& to = checked("closest", closest);
        const std::size_t n = points.count;
        const BasicPointSpan<Real> asked{span_of("x", points.x, n), span_of("y", points.y, n),
                                         span_of("z", points.z, n)};
        QueryStatistics statistics;
        checked("tracer", tracer)
            .tracer.closest(asked,
                            ClosestSpan{span_of(to.distance, n), span_of(to.point_x, n),
                                        span_of(to.point_y, n), span_of(to.point_z, n),
                                        span_of(to.shape_id, n), span_of(to.face, n)},
                            span_of(max_distance, n), &statistics);
        if (points.refused != nullptr) *points.refused = statistics.refused;
    });
}

} // namespace

raylane_status raylane_closest(const raylane_tracer* tracer, const raylane_points* points,
                               const double* max_distance, const raylane_closest_points* closest) {
    return find_closest<float>(tracer, points, max_distance, closest);
}

raylane_status raylane_closest_doubles(const raylane_tracer* tracer,
                                       const raylane_double_points* points,
                                       const double* max_distance,
                                       const raylane_closest_points* closest) {
    return find_closest<double>(tracer, points, max_distance, closest);
}
