#include "raylane/tracer.hpp"

#include "scenes/api/cpp/internals.hpp"
#include "scenes/api/cpp/translate.hpp"
#include "simd/stream/row_worker.hpp"
#include "simd/stream/stream_tracer.hpp"
#include "simd/threads/threads.hpp"

#include <string>
#include <utility>

namespace raylane {

namespace {

void require_length(const char* name, std::size_t length, std::size_t count,
                    const char* of = "rays") {
    if (length != count)
        throw InvalidValue(name, "must have one element for each of " + std::to_string(count) +
                                     " " + of + ", got " + std::to_string(length));
}

/// Returns the elements of an optional span, or null if it is empty. Throws InvalidValue if it has
/// another length than `count`.
template <class Element>
Element* optional(const char* name, std::span<Element> span, std::size_t count) {
    if (span.empty()) return nullptr;
    require_length(name, span.size(), count);
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
            optional("shape", hits.shape, count),
            optional("entering", hits.entering, count),
            optional("face", hits.face, count),
            optional("t_double", hits.t_double, count)};
}

template <class Real>
void find_nearest(const simd::StreamTracer& tracer, const BasicRaySpan<Real>& rays,
                  const HitSpan& hits) {
    const simd::RayStream<Real> stream = stream_of(rays);
    tracer.nearest(stream, stream_of(hits, stream.count));
}

template <class Real>
void find_occluded(const simd::StreamTracer& tracer, const BasicRaySpan<Real>& rays,
                   std::span<std::uint8_t> occluded) {
    const simd::RayStream<Real> stream = stream_of(rays);
    require_length("occluded", occluded.size(), stream.count);
    tracer.occluded(stream, occluded.data());
}

template <class Real>
void find_crossings(const simd::StreamTracer& tracer, const BasicRaySpan<Real>& rays,
                    CrossingRows& rows, const CrossingOptions& options,
                    CrossingStatistics* statistics) {
    simd::CrossingRows found;
    simd::CrossingCounters counters;
    tracer.crossings(stream_of(rays), {options.most, options.normals}, found, counters);
    rows = {std::move(found.first),    std::move(found.t),         std::move(found.shape),
            std::move(found.entering), std::move(found.face),      std::move(found.tied),
            std::move(found.touching), std::move(found.normal[0]), std::move(found.normal[1]),
            std::move(found.normal[2])};
    if (statistics != nullptr)
        *statistics = {counters.order.by_bounds, counters.order.by_digits, counters.order.exactly,
                       counters.widened};
}

template <class Real>
void find_solids(const simd::StreamTracer& tracer, const BasicPointSpan<Real>& points,
                 SolidRows& rows) {
    const std::size_t count = points.x.size();
    require_length("y", points.y.size(), count, "points");
    require_length("z", points.z.size(), count, "points");
    simd::SolidRows found;
    tracer.containing(
        simd::PointStream<Real>{count, {points.x.data(), points.y.data(), points.z.data()}}, found);
    rows = {std::move(found.first), std::move(found.shape), std::move(found.on_surface)};
}

template <class Real>
void find_lengths(const simd::StreamTracer& tracer, const BasicRaySpan<Real>& rays,
                  LengthRows& rows) {
    simd::LengthRows found;
    tracer.path_lengths(stream_of(rays), found);
    rows = {std::move(found.first), std::move(found.material), std::move(found.length)};
}

} // namespace

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

void Tracer::intersect(const RaySpan& rays, const HitSpan& hits) const {
    find_nearest(*tracer_, rays, hits);
}

void Tracer::intersect(const DoubleRaySpan& rays, const HitSpan& hits) const {
    find_nearest(*tracer_, rays, hits);
}

void Tracer::occluded(const RaySpan& rays, std::span<std::uint8_t> occluded) const {
    find_occluded(*tracer_, rays, occluded);
}

void Tracer::occluded(const DoubleRaySpan& rays, std::span<std::uint8_t> occluded) const {
    find_occluded(*tracer_, rays, occluded);
}

void Tracer::crossings(const RaySpan& rays, CrossingRows& rows, const CrossingOptions& options,
                       CrossingStatistics* statistics) const {
    find_crossings(*tracer_, rays, rows, options, statistics);
}

void Tracer::crossings(const DoubleRaySpan& rays, CrossingRows& rows,
                       const CrossingOptions& options, CrossingStatistics* statistics) const {
    find_crossings(*tracer_, rays, rows, options, statistics);
}

void Tracer::contains(const PointSpan& points, SolidRows& rows) const {
    find_solids(*tracer_, points, rows);
}

void Tracer::contains(const DoublePointSpan& points, SolidRows& rows) const {
    find_solids(*tracer_, points, rows);
}

void Tracer::path_lengths(const RaySpan& rays, LengthRows& rows) const {
    find_lengths(*tracer_, rays, rows);
}

void Tracer::path_lengths(const DoubleRaySpan& rays, LengthRows& rows) const {
    find_lengths(*tracer_, rays, rows);
}

} // namespace raylane
