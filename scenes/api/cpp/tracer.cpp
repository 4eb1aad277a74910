#include "raylane/tracer.hpp"

#include "scenes/api/cpp/internals.hpp"
#include "scenes/api/cpp/translate.hpp"
#include "simd/stream/row_worker.hpp"
#include "simd/stream/stream_tracer.hpp"
#include "simd/threads/threads.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace raylane {

namespace {

void require_length(const char* name, std::size_t length, std::size_t count,
                    const char* subject = "rays") {
    if (length != count)
        throw InvalidValue(name, "must have one element for each of " + std::to_string(count) +
                                     " " + subject + ", got " + std::to_string(length));
}

/// Returns the elements of an optional span, or null if it is empty. Throws InvalidValue if it has
/// another length than `count`.
template <class Element>
Element* optional(const char* name, std::span<Element> span, std::size_t count,
                  const char* subject = "rays") {
    if (span.empty()) return nullptr;
    require_length(name, span.size(), count, subject);
    return span.data();
}

template <class Real>
simd::RayStream<Real> stream_of(const BasicRaySpan<Real>& rays) {
    const std::size_t count = rays.origin_x.size();
    require_length("origin_y", rays.origin_y.size(), count);
    require_length("origin_z", rays.origin_z.size(), count);
    require_length("direction_x", rays.direction_x.size(), count);
    require_length("direction_y", rays.direction_y.size(), count);
    require_length("direction_z", rays.direction_z.size(), count);
    return {count,
            {rays.origin_x.data(), rays.origin_y.data(), rays.origin_z.data()},
            {rays.direction_x.data(), rays.direction_y.data(), rays.direction_z.data()},
            optional("t_min", rays.t_min, count),
            optional("t_max", rays.t_max, count),
            optional("origin_shape", rays.origin_shape, count),
            optional("origin_face", rays.origin_face, count),
            optional("origin_inward", rays.origin_inward, count)};
}

simd::HitStream stream_of(const HitSpan& hits, std::size_t count) {
    return {optional("t", hits.t, count),
            {optional("normal_x", hits.normal_x, count), optional("normal_y", hits.normal_y, count),
             optional("normal_z", hits.normal_z, count)},
            optional("shape_id", hits.shape_id, count),
            optional("entering", hits.entering, count),
            optional("face", hits.face, count),
            optional("t_double", hits.t_double, count)};
}

simd::NormalStream normals_of(const HitSpan& hits, std::size_t count) {
    return {{optional("normal_double_x", hits.normal_double_x, count),
             optional("normal_double_y", hits.normal_double_y, count),
             optional("normal_double_z", hits.normal_double_z, count)}};
}

template <class Real>
simd::PointStream<Real> stream_of(const BasicPointSpan<Real>& points) {
    const std::size_t count = points.x.size();
    require_length("y", points.y.size(), count, "points");
    require_length("z", points.z.size(), count, "points");
    return {count, {points.x.data(), points.y.data(), points.z.data()}};
}

/// Calls query() for a stream of rays, and names the ray whose start is invalid.
template <class Real, class Query>
std::size_t answered(const simd::RayStream<Real>& stream, const Query& query) {
    try {
        return query();
    } catch (const simd::InvalidStart& invalid) {
        throw InvalidRay(invalid.field, static_cast<std::size_t>(invalid.ray - stream.origin_shape),
                         invalid.expectation);
    }
}

/// Stores the number of refused rays or points.
void store(std::size_t refused, QueryStatistics* statistics) {
    if (statistics != nullptr) *statistics = {refused};
}

template <class Real>
void find_nearest(const simd::StreamTracer& tracer, const BasicRaySpan<Real>& rays,
                  const HitSpan& hits, QueryStatistics* statistics) {
    const simd::RayStream<Real> stream = stream_of(rays);
    const simd::HitStream to = stream_of(hits, stream.count);
    const simd::NormalStream normals = normals_of(hits, stream.count);
    store(answered(stream, [&] { return tracer.nearest(stream, to, normals); }), statistics);
}

template <class Real>
void find_occluded(const simd::StreamTracer& tracer, const BasicRaySpan<Real>& rays,
                   std::span<std::uint8_t> occluded, QueryStatistics* statistics) {
    const simd::RayStream<Real> stream = stream_of(rays);
    require_length("occluded", occluded.size(), stream.count);
    store(answered(stream, [&] { return tracer.occluded(stream, occluded.data()); }), statistics);
}

template <class Real>
void find_crossings(const simd::StreamTracer& tracer, const BasicRaySpan<Real>& rays,
                    CrossingRows& rows, const CrossingOptions& options,
                    CrossingStatistics* statistics) {
    simd::CrossingRows found;
    simd::CrossingCounters counters;
    const simd::RayStream<Real> stream = stream_of(rays);
    const std::size_t refused = answered(stream, [&] {
        return tracer.crossings(stream, {options.most, options.normals, options.normals_double},
                                found, counters);
    });
    rows = {std::move(found.first),
            std::move(found.t),
            std::move(found.shape),
            std::move(found.entering),
            std::move(found.face),
            std::move(found.tied),
            std::move(found.touching),
            std::move(found.normal[0]),
            std::move(found.normal[1]),
            std::move(found.normal[2]),
            std::move(found.normal_double[0]),
            std::move(found.normal_double[1]),
            std::move(found.normal_double[2])};
    if (statistics != nullptr)
        *statistics = {counters.order.by_bounds, counters.order.by_digits, counters.order.exactly,
                       counters.widened, refused};
}

template <class Real>
void find_counts(const simd::StreamTracer& tracer, const BasicRaySpan<Real>& rays,
                 std::span<std::uint64_t> counts, QueryStatistics* statistics) {
    const simd::RayStream<Real> stream = stream_of(rays);
    require_length("counts", counts.size(), stream.count);
    store(answered(stream, [&] { return tracer.count_crossings(stream, counts.data()); }),
          statistics);
}

template <class Real>
void find_solids(const simd::StreamTracer& tracer, const BasicPointSpan<Real>& points,
                 SolidRows& rows, QueryStatistics* statistics) {
    simd::SolidRows found;
    store(library::translated([&] { return tracer.containing(stream_of(points), found); }),
          statistics);
    rows = {std::move(found.first), std::move(found.shape), std::move(found.inside),
            std::move(found.on_surface)};
}

template <class Real>
void find_cells(const simd::StreamTracer& tracer, const BasicPointSpan<Real>& points,
                const CellSpan& cells, QueryStatistics* statistics) {
    static_assert(no_material == core::no_medium);
    const simd::PointStream<Real> stream = stream_of(points);
    const simd::CellStream to{optional("shape_id", cells.shape_id, stream.count, "points"),
                              optional("material", cells.material, stream.count, "points"),
                              optional("on_surface", cells.on_surface, stream.count, "points")};
    store(library::translated([&] { return tracer.cells(stream, to); }), statistics);
}

template <class Real>
void find_closest(const simd::StreamTracer& tracer, const BasicPointSpan<Real>& points,
                  const ClosestSpan& closest, std::span<const double> max_distance,
                  QueryStatistics* statistics) {
    const simd::PointStream<Real> stream = stream_of(points);
    const auto wanted = [&](const char* name, auto span) {
        return optional(name, span, stream.count, "points");
    };
    const simd::ClosestStream to{wanted("distance", closest.distance),
                                 {wanted("point_x", closest.point_x),
                                  wanted("point_y", closest.point_y),
                                  wanted("point_z", closest.point_z)},
                                 wanted("shape_id", closest.shape_id),
                                 wanted("face", closest.face)};
    const double* const limits = wanted("max_distance", max_distance);
    store(library::translated([&] { return tracer.closest(stream, limits, to); }), statistics);
}

template <class Real, class AnyRows>
void find_lengths(const simd::StreamTracer& tracer, const BasicRaySpan<Real>& rays,
                  core::Bodies bodies, AnyRows& rows, QueryStatistics* statistics) {
    simd::LengthRows found;
    const simd::RayStream<Real> stream = stream_of(rays);
    store(answered(stream, [&] { return tracer.path_lengths(stream, bodies, found); }), statistics);
    rows = {std::move(found.first), std::move(found.body), std::move(found.length)};
}

template <class Real>
OnwardRays<Real> rays_onward(const BasicRaySpan<Real>& rays, const HitSpan& hits,
                             const std::span<const Real> (&directions)[3]) {
    const simd::RayStream<Real> from = stream_of(rays);
    const std::size_t count = from.count;
    const char* const names[] = {"direction_x", "direction_y", "direction_z"};
    const std::span<float> normal[] = {hits.normal_x, hits.normal_y, hits.normal_z};
    const char* const normals[] = {"normal_x", "normal_y", "normal_z"};
    for (int axis = 0; axis < 3; ++axis) {
        require_length(names[axis], directions[axis].size(), count);
        require_length(normals[axis], normal[axis].size(), count);
    }
    if (hits.t_double.empty())
        require_length("t", hits.t.size(), count);
    else
        require_length("t_double", hits.t_double.size(), count);
    require_length("shape_id", hits.shape_id.size(), count);
    require_length("face", hits.face.size(), count);

    OnwardRays<Real> onward;
    onward.shape_id.assign(hits.shape_id.begin(), hits.shape_id.end());
    onward.face.assign(hits.face.begin(), hits.face.end());
    onward.inward.resize(count);
    std::vector<Real>* const origins[] = {&onward.origin_x, &onward.origin_y, &onward.origin_z};
    for (int axis = 0; axis < 3; ++axis) {
        origins[axis]->resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double t =
                hits.t_double.empty() ? static_cast<double>(hits.t[i]) : hits.t_double[i];
            const double at = static_cast<double>(from.origin[axis][i]) +
                              t * static_cast<double>(from.direction[axis][i]);
            (*origins[axis])[i] = hits.shape_id[i] == no_shape
                                      ? std::numeric_limits<Real>::quiet_NaN()
                                      : static_cast<Real>(at);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        double along = 0.0, size = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto component = static_cast<double>(directions[axis][i]);
            along += static_cast<double>(normal[axis][i]) * component;
            size += std::abs(component);
        }
        // Components of normals are off by at most 2^-25. The rest covers the sums' roundings.
        const double off = 0x1.1p-25 * size;
        onward.inward[i] = along < -off ? 1 : along > off ? 0 : 2;
    }
    onward.direction_x = directions[0];
    onward.direction_y = directions[1];
    onward.direction_z = directions[2];
    return onward;
}

} // namespace

OnwardRays<float> onward(const RaySpan& rays, const HitSpan& hits,
                         std::span<const float> direction_x, std::span<const float> direction_y,
                         std::span<const float> direction_z) {
    return rays_onward<float>(rays, hits, {direction_x, direction_y, direction_z});
}

OnwardRays<double> onward(const DoubleRaySpan& rays, const HitSpan& hits,
                          std::span<const double> direction_x, std::span<const double> direction_y,
                          std::span<const double> direction_z) {
    return rays_onward<double>(rays, hits, {direction_x, direction_y, direction_z});
}

void library::require_threads(int threads) {
    if (threads < 0 || threads > simd::max_threads)
        throw InvalidValue("threads", "must be from 0 to " + std::to_string(simd::max_threads) +
                                          ", got " + std::to_string(threads));
}

core::Precision library::core_precision(Precision precision) {
    static_assert(int(Precision::fast) == int(core::Precision::fast) &&
                  int(Precision::robust) == int(core::Precision::robust) &&
                  int(Precision::exact) == int(core::Precision::exact) &&
                  int(Precision::plain_double) == int(core::Precision::plain_double));
    if (precision > Precision::plain_double) throw InvalidValue("precision", "must be a Precision");
    return static_cast<core::Precision>(precision);
}

Tracer::Tracer(const Scene& scene, const TracerOptions& options) : scene_(scene) {
    library::require_threads(options.threads);
    const core::Precision precision = library::core_precision(options.precision);
    tracer_ = library::translated([&] {
        return std::make_shared<const simd::StreamTracer>(
            library::Internals::of(scene_),
            options.threads > 0 ? options.threads : simd::default_threads(), simd::best_isa(),
            precision);
    });
}

void Tracer::intersect(const RaySpan& rays, const HitSpan& hits,
                       QueryStatistics* statistics) const {
    find_nearest(*tracer_, rays, hits, statistics);
}

void Tracer::intersect(const DoubleRaySpan& rays, const HitSpan& hits,
                       QueryStatistics* statistics) const {
    find_nearest(*tracer_, rays, hits, statistics);
}

void Tracer::occluded(const RaySpan& rays, std::span<std::uint8_t> occluded,
                      QueryStatistics* statistics) const {
    find_occluded(*tracer_, rays, occluded, statistics);
}

void Tracer::occluded(const DoubleRaySpan& rays, std::span<std::uint8_t> occluded,
                      QueryStatistics* statistics) const {
    find_occluded(*tracer_, rays, occluded, statistics);
}

void Tracer::crossings(const RaySpan& rays, CrossingRows& rows, const CrossingOptions& options,
                       CrossingStatistics* statistics) const {
    find_crossings(*tracer_, rays, rows, options, statistics);
}

void Tracer::crossings(const DoubleRaySpan& rays, CrossingRows& rows,
                       const CrossingOptions& options, CrossingStatistics* statistics) const {
    find_crossings(*tracer_, rays, rows, options, statistics);
}

void Tracer::count_crossings(const RaySpan& rays, std::span<std::uint64_t> counts,
                             QueryStatistics* statistics) const {
    find_counts(*tracer_, rays, counts, statistics);
}

void Tracer::count_crossings(const DoubleRaySpan& rays, std::span<std::uint64_t> counts,
                             QueryStatistics* statistics) const {
    find_counts(*tracer_, rays, counts, statistics);
}

void Tracer::contains(const PointSpan& points, SolidRows& rows, QueryStatistics* statistics) const {
    find_solids(*tracer_, points, rows, statistics);
}

void Tracer::contains(const DoublePointSpan& points, SolidRows& rows,
                      QueryStatistics* statistics) const {
    find_solids(*tracer_, points, rows, statistics);
}

void Tracer::cells(const PointSpan& points, const CellSpan& cells,
                   QueryStatistics* statistics) const {
    find_cells(*tracer_, points, cells, statistics);
}

void Tracer::cells(const DoublePointSpan& points, const CellSpan& cells,
                   QueryStatistics* statistics) const {
    find_cells(*tracer_, points, cells, statistics);
}

void Tracer::closest(const PointSpan& points, const ClosestSpan& closest,
                     std::span<const double> max_distance, QueryStatistics* statistics) const {
    find_closest(*tracer_, points, closest, max_distance, statistics);
}

void Tracer::closest(const DoublePointSpan& points, const ClosestSpan& closest,
                     std::span<const double> max_distance, QueryStatistics* statistics) const {
    find_closest(*tracer_, points, closest, max_distance, statistics);
}

void Tracer::path_lengths(const RaySpan& rays, LengthRows& rows,
                          QueryStatistics* statistics) const {
    find_lengths(*tracer_, rays, core::Bodies::materials, rows, statistics);
}

void Tracer::path_lengths(const DoubleRaySpan& rays, LengthRows& rows,
                          QueryStatistics* statistics) const {
    find_lengths(*tracer_, rays, core::Bodies::materials, rows, statistics);
}

void Tracer::solid_lengths(const RaySpan& rays, SolidLengthRows& rows,
                           QueryStatistics* statistics) const {
    find_lengths(*tracer_, rays, core::Bodies::solids, rows, statistics);
}

void Tracer::solid_lengths(const DoubleRaySpan& rays, SolidLengthRows& rows,
                           QueryStatistics* statistics) const {
    find_lengths(*tracer_, rays, core::Bodies::solids, rows, statistics);
}

} // namespace raylane
