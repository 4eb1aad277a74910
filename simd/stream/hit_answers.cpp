#include "core/reference/crossing_order.hpp"
#include "core/shapes/solve.hpp"
#include "simd/query/as_core.hpp"
#include "simd/stream/worker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::simd {

namespace {

/// Converts a normal to float, without -0.
core::Vec3f in_float(const core::Vec3d& normal) {
    return core::convert<float>(normal) + core::Vec3f(0.0F);
}

} // namespace

/// Crossings of some lanes in extended precision.
struct StreamWorker::Widened {
    static constexpr std::size_t most = 128;

    std::span<const std::uint32_t> lanes;
    double high[most], low[most], error[most];
    float normal[3][most];
    std::uint8_t rounded[most];

    core::DoubleDouble t(std::size_t k) const { return {high[k], low[k]}; }
};

/// Computes t in double of lanes that have hits.
void StreamWorker::sharpen(std::span<const std::uint32_t> lanes, const HitStream& hits) {
    for (std::size_t first = 0; first < lanes.size(); first += Widened::most) {
        const Widened widened = widen(lanes.subspan(first), false);
        for (std::size_t k = 0; k < widened.lanes.size(); ++k)
            hits.t_double[widened.lanes[k]] = double_t_of(widened, k);
    }
}

/// Extends the precision of the first lanes of `lanes`.
StreamWorker::Widened StreamWorker::widen(std::span<const std::uint32_t> lanes,
                                          bool with_normals) const {
    Widened widened;
    widened.lanes = lanes.first(std::min(lanes.size(), Widened::most));
    if (!is_exact()) { // t as it was found
        for (std::size_t k = 0; k < widened.lanes.size(); ++k) {
            widened.high[k] = hit_at(widened.lanes[k]).t;
            widened.low[k] = widened.error[k] = 0.0;
            widened.rounded[k] = 0;
        }
        return widened;
    }
    std::size_t places[Widened::most];
    std::copy(widened.lanes.begin(), widened.lanes.end(), places);
    WideCrossings wide{widened.high, widened.low, widened.error};
    if (with_normals) {
        for (int axis = 0; axis < 3; ++axis)
            wide.normal[axis] = widened.normal[axis];
        wide.rounded = widened.rounded;
    }
    tracing_.method().refine.widen(scene_.view_with_copies(),
                                   query_.hits().found(intake_.paths(), 0, intake_.paths().count),
                                   places, widened.lanes.size(), wide);
    return widened;
}

/// Returns a crossing's t for the caller.
double StreamWorker::double_t_of(const Widened& widened, std::size_t k) const {
    const std::uint32_t lane = widened.lanes[k];
    const double unit = intake_.taken().unit[lane], nearest = widened.high[k] * unit;
    if (core::rounds_surely(widened.t(k), widened.error[k]) && std::isnormal(nearest))
        return nearest;
    const core::LeavingRay from{ray_of(intake_.paths(), lane),
                                origin_surfaces_of(scene_, intake_.paths(), lane)};
    return core::nearest_double_t(scene_.scene(), from, hit_at(lane), std::ilogb(unit));
}

/// Answers doubtful rays by the scalar search or, where only floats are in doubt, by their hits.
template <class Real>
void StreamWorker::answer(const RayStream<Real>& rays, std::span<std::uint32_t> lanes,
                          const HitStream& hits) {
    const Hits& found = query_.hits();
    const auto is_found = [&](std::uint32_t lane) { return (found.hit[lane] & hit_doubtful) == 0; };
    const auto lost = std::partition(lanes.begin(), lanes.end(), is_found);
    for (auto lane = lost; lane != lanes.end(); ++lane)
        search(intake_.lone(rays, *lane, *lane), hits, *lane);
    const std::span<const std::uint32_t> others(lanes.begin(), lost);
    for (std::size_t first = 0; first < others.size(); first += Widened::most) {
        const Widened widened = widen(others.subspan(first), hits.wants_normals());
        for (std::size_t k = 0; k < widened.lanes.size(); ++k)
            answer(intake_.lone(rays, widened.lanes[k], widened.lanes[k]), widened, k, hits);
    }
}

/// Answers a ray with the hit that has been found for it, if that is before the ray's end.
void StreamWorker::answer(const LoneRay& ray, const Widened& widened, std::size_t k,
                          const HitStream& hits) {
    const std::uint32_t lane = widened.lanes[k];
    const core::Scene& scene = scene_.scene();
    core::Hit<double> hit = hit_at(lane);
    if (is_exact())
        hit = core::SharpHit(hit, widened.t(k), widened.error[k]).sharpened();
    else
        hit.error = 0.0;
    const float t = is_exact() ? ray.t_of(scene, hit) : t_at(lane, ray);
    const bool counts =
        ray.by_floats ? static_cast<double>(t) <= ray.t_max : ray.is_before_t_max(scene, hit);
    if (!counts) return store_none(hits, lane);
    core::Vec3f normal(0.0F);
    if (hits.wants_normals()) normal = normal_of(ray, hit, widened, k);
    store(hits, lane, t, hits.t_double != nullptr ? double_t_of(widened, k) : 0.0, normal,
          hit.shape, hit.enters(), hit.face);
}

core::Vec3f StreamWorker::normal_of(const LoneRay& ray, const core::Hit<double>& hit,
                                    const Widened& widened, std::size_t k) const {
    const Hits& found = query_.hits();
    const std::uint32_t lane = widened.lanes[k];
    if ((found.hit[lane] & (hit_normal_doubtful | hit_normal_unknown)) == 0)
        return in_float({found.normal[0][lane], found.normal[1][lane], found.normal[2][lane]});
    core::Vec3f known;
    for (int axis = 0; axis < 3; ++axis)
        known[axis] = (widened.rounded[k] >> axis & 1) != 0
                          ? widened.normal[axis][k]
                          : std::numeric_limits<float>::quiet_NaN();
    const core::Vec3f normal =
        widened.rounded[k] == 7 ? known
                                : core::rounded_normal(scene_.scene(), ray.leaving(), hit, known);
    return (hit.reversed ? -normal : normal) + core::Vec3f(0.0F); // no -0
}

/// Returns true if the lane's hit is not beyond the upper limit.
bool StreamWorker::is_before_t_max(std::size_t lane, const LoneRay& ray) const {
    return ray.by_floats ? static_cast<double>(t_at(lane, ray)) <= ray.t_max
                         : ray.is_before_t_max(scene_.scene(), hit_at(lane));
}

/// Answers one ray by the scalar search.
void StreamWorker::search(const LoneRay& ray, const HitStream& hits, std::size_t i) {
    const auto counts = [&](const core::Hit<double>& hit) {
        return ray.finds(scene_.scene(), hit);
    };
    const core::Hit<double> hit = searcher_.nearest(ray.ray, ray.origins, counts, ray.t_limit).hit;
    if (!hit.any()) return store_none(hits, i);
    core::Vec3f normal(0.0F);
    if (hits.wants_normals())
        normal = is_exact() ? core::rounded_normal(scene_.scene(), ray.leaving(), hit)
                            : in_float(searcher_.surface_at(ray.ray, ray.origins, hit).normal);
    if (hit.reversed) normal = core::Vec3f(0.0F) - normal; // no -0
    const double t_double = hits.t_double == nullptr ? 0.0
                            : is_exact()             ? ray.double_t_of(scene_.scene(), hit)
                                                     : ray.as_answered(hit.t);
    store(hits, i, ray.t_of(scene_.scene(), hit), t_double, normal, hit.shape, hit.enters(),
          hit.face);
    if (hits.touching != nullptr) hits.touching[i] = touches(ray, hit) ? 1 : 0;
}

/// Finds which of the hits that were found are those of rays that only touch the shape.
template <class Real>
void StreamWorker::find_touching(const RayStream<Real>& rays, std::uint8_t* touching) {
    for (std::size_t lane = 0; lane < rays.count; ++lane)
        touching[lane] = intake_.is_ray(lane) && query_.was_refined(lane) &&
                                 query_.hits().slot[lane] != no_slot &&
                                 touches(intake_.lone(rays, lane, lane), hit_at(lane))
                             ? 1
                             : 0;
}

/// Returns true if the ray also enters the shape where it leaves it, or the other way round.
bool StreamWorker::touches(const LoneRay& ray, const core::Hit<double>& hit) {
    const core::Scene& scene = scene_.scene();
    const core::CrossingOrder order(scene, ray.leaving());
    return core::with_table(scene.shapes(), hit.kind, [&](const auto& table) {
        std::uint64_t widened = 0;
        const auto answers =
            core::solve(table.get(hit.place), ray.ray, ray.origins.start_on(hit.shape), widened);
        return std::any_of(
            answers.begin(), answers.end(), [&](const core::Crossing<double>& crossing) {
                const core::Hit<double> other(crossing, hit.shape, hit.kind, hit.place,
                                              hit.reversed);
                return other.entering != hit.entering && order.compare(other, hit) == 0 &&
                       ray.finds(scene, other) && solid_surfaces_.is_surface(ray.leaving(), other);
            });
    });
}

/// Returns the normal of the hit of ray i as doubles, or 0 if ray i hits nothing.
template <class Real>
core::Vec3d StreamWorker::double_normal_of(const RayStream<Real>& rays, const HitStream& hits,
                                           std::size_t i) {
    const core::ShapeId shape = hits.shape[i];
    if (shape == core::no_shape) return core::Vec3d(0.0);
    const std::uint32_t slot = shapes_.slots()[shape];
    const SceneData::ShapeRecord record = scene_.record_of(slot);
    const LoneRay ray = intake_.alone(rays, i);
    core::Hit<double> hit({std::ldexp(hits.t_double[i], -ray.exponent), hits.face[i],
                           (hits.entering[i] != 0) != record.reversed},
                          shape, record.kind, scene_.place_of(slot), record.reversed);
    if (is_exact()) {
        // Twice the error of rounding; not known for numbers that were clamped or are subnormal.
        const bool is_known = std::isnormal(hits.t_double[i]) && std::isnormal(hit.t) &&
                              hits.t_double[i] < std::numeric_limits<double>::max();
        hit.error = is_known ? 0x1p-52 * hit.t : std::numeric_limits<double>::infinity();
        return ray.double_normal_of(scene_.scene(), hit);
    }
    const core::Vec3d normal = searcher_.surface_at(ray.ray, ray.origins, hit).normal;
    return hit.reversed ? core::Vec3d(0.0) - normal : normal + core::Vec3d(0.0); // no -0
}

/// Returns t of the lane's hit for the caller.
float StreamWorker::t_at(std::size_t lane, const LoneRay& ray) const {
    const Hits& found = query_.hits();
    const double per_unit = intake_.taken().unit[lane] / intake_.paths().length_of(lane);
    const double t = found.t[lane] * per_unit;
    float rounded = 0.0F;
    // The length and both operations have errors of a few ulps.
    const double error = found.error[lane] * per_unit * (1.0 + 0x1p-50) + 0x1p-50 * t;
    if (core::rounds_surely(t, is_exact() ? error : 0.0, rounded)) return rounded;
    return ray.t_of(scene_.scene(), hit_at(lane));
}

/// Returns the lane's hit in core's format.
core::Hit<double> StreamWorker::hit_at(std::size_t lane) const {
    return hit_of(scene_, intake_.paths(), query_.hits(), lane);
}

template void StreamWorker::answer(const RayStream<float>&, std::span<std::uint32_t>,
                                   const HitStream&);
template void StreamWorker::answer(const RayStream<double>&, std::span<std::uint32_t>,
                                   const HitStream&);
template void StreamWorker::find_touching(const RayStream<float>&, std::uint8_t*);
template void StreamWorker::find_touching(const RayStream<double>&, std::uint8_t*);
template core::Vec3d StreamWorker::double_normal_of(const RayStream<float>&, const HitStream&,
                                                    std::size_t);
template core::Vec3d StreamWorker::double_normal_of(const RayStream<double>&, const HitStream&,
                                                    std::size_t);

} // namespace raylane::simd
