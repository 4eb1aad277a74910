#include "simd/stream/worker.hpp"

#include "core/reference/crossing_order.hpp"
#include "core/shapes/solve.hpp"
#include "simd/query/as_core.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace raylane::simd {

namespace {

/// Converts a normal to float, without -0.
core::Vec3f in_float(const core::Vec3d& normal) {
    return core::convert<float>(normal) + core::Vec3f(0.0F);
}

} // namespace

StreamWorker::StreamWorker(const SceneData& scene, const Tracing& tracing,
                           const ShapesByName& shapes)
    : scene_(scene), shapes_(shapes), tracing_(tracing),
      searcher_(scene.scene(), core::Search::hierarchy, tracing.precision),
      solid_surfaces_(scene.scene()), query_(scene, tracing, Asked::floats), expressions_(scene),
      intake_(scene, tracing, shapes, at_a_time()), few_(scene, tracing, shapes) {
    const std::size_t capacity = at_a_time();
    arena_ = arena_for([&](Arena& arena) {
        query_.take_from(arena, capacity);
        intake_.take_from(arena);
        doubtful_ = arena.take<std::uint32_t>(capacity);
        unsharp_ = arena.take<std::uint32_t>(capacity);
        state_ = arena.take<std::uint8_t>(capacity);
    });
}

/// Returns the number of rays that search for nearest hits together.
std::size_t StreamWorker::at_a_time() const {
    constexpr std::size_t otherwise = 1024;
    return is_exact() ? scene_.best_ray_count() : otherwise;
}

/// Takes all rays in, some at a time. Calls as_they_are(some, first), or in_tiles(first, count) for
/// rays for which the tiles' order is worthwhile.
template <class Real, class AsTheyAre, class InTiles>
void StreamWorker::in_good_order(const RayStream<Real>& rays, const AsTheyAre& as_they_are,
                                 const InTiles& in_tiles) {
    std::size_t in_order = 0; // up to here, the rays' own order is good enough
    for (std::size_t first = 0, count = 0; first < rays.count; first += count) {
        const RayStream<Real> some = intake_.take(rays, first);
        count = some.count;
        if (first >= in_order && are_better_in_tiles(rays, first)) {
            const std::size_t most = std::min(rays.count - first, TileOrder::most);
            if (tiles_.find(part_of(rays, first, most), intake_.coherence()->parallel)) {
                in_tiles(first, most);
                count = most;
                continue;
            }
            in_order = first + most;
        }
        as_they_are(some, first);
    }
}

template <class Real>
std::size_t StreamWorker::nearest(const RayStream<Real>& rays, const HitStream& hits,
                                  const NormalStream& normals) {
    intake_.answer_floats(std::is_same_v<Real, float> ||
                          (hits.t != nullptr && hits.t_double == nullptr));
    if (!normals.any()) return find_nearest(rays, hits);
    std::size_t refused = 0;
    for (std::size_t first = 0, count = 0; first < rays.count; first += count) {
        count = std::min(rays.count - first, TileOrder::most);
        const RayStream<Real> some = part_of(rays, first, count);
        HitStream found = part_of(hits, first);
        columns_.add_missing(found, count);
        refused += find_nearest(some, found);
        for (std::size_t i = 0; i < count; ++i) {
            const core::Vec3d normal = double_normal_of(some, found, i);
            for (int axis = 0; axis < 3; ++axis)
                if (normals.normal[axis] != nullptr) normals.normal[axis][first + i] = normal[axis];
        }
    }
    return refused;
}

template <class Real>
std::size_t StreamWorker::find_nearest(const RayStream<Real>& rays, const HitStream& hits) {
    refused_ = 0;
    if (few_.can_answer(rays) && hits.t_double == nullptr) {
        for (std::size_t i = 0; i < rays.count; ++i)
            if (!few_.nearest(rays, i, hits))
                nearest_of(intake_.take(part_of(rays, i, 1), 0), part_of(hits, i));
        return refused_;
    }
    in_good_order(
        rays,
        [&](const RayStream<Real>& some, std::size_t first) {
            nearest_of(some, part_of(hits, first));
        },
        [&](std::size_t first, std::size_t count) {
            nearest_in_tiles(part_of(rays, first, count), part_of(hits, first));
        });
    return refused_;
}

template <class Real>
std::size_t StreamWorker::occluded(const RayStream<Real>& rays, std::uint8_t* occluded) {
    refused_ = 0;
    intake_.answer_floats(std::is_same_v<Real, float>);
    if (few_.can_answer(rays)) {
        for (std::size_t i = 0; i < rays.count; ++i) {
            const std::optional<bool> is = few_.occluded(rays, i);
            if (is.has_value())
                occluded[i] = *is ? 1 : 0;
            else
                occluded_of(intake_.take(part_of(rays, i, 1), 0), occluded + i);
        }
        return refused_;
    }
    in_good_order(
        rays,
        [&](const RayStream<Real>& some, std::size_t first) {
            occluded_of(some, occluded + first);
        },
        [&](std::size_t first, std::size_t count) {
            occluded_in_tiles(part_of(rays, first, count), occluded + first);
        });
    return refused_;
}

/// Returns true if it is worthwhile to look for the tiles' order of the rays taken last and those
/// behind them.
template <class Real>
bool StreamWorker::are_better_in_tiles(const RayStream<Real>& rays, std::size_t first) const {
    return intake_.coherence() != nullptr && !intake_.coherence()->loose &&
           !intake_.coherence()->converging && scene_.best_in_tiles() &&
           rays.origin_shape == nullptr && rays.count - first >= TileOrder::least;
}

/// Finds the nearest hits of rays in the order that has been found for them.
template <class Real>
void StreamWorker::nearest_in_tiles(const RayStream<Real>& rays, const HitStream& hits) {
    const std::span<const std::uint32_t> order = tiles_.order();
    const auto [sorted, found] = tile_columns_.take(rays, hits, order);
    for (std::size_t first = 0, count = 0; first < sorted.count; first += count) {
        const RayStream<Real> some = intake_.take(sorted, first);
        count = some.count;
        nearest_of(some, part_of(found, first));
    }
    TileColumns::hand_back(found, order, hits);
}

template <class Real>
void StreamWorker::occluded_in_tiles(const RayStream<Real>& rays, std::uint8_t* occluded) {
    const std::span<const std::uint32_t> order = tiles_.order();
    HitStream answers; // one column of bytes
    answers.entering = occluded;
    const auto [sorted, found] = tile_columns_.take(rays, answers, order);
    for (std::size_t first = 0, count = 0; first < sorted.count; first += count) {
        const RayStream<Real> some = intake_.take(sorted, first);
        count = some.count;
        occluded_of(some, found.entering + first);
    }
    TileColumns::hand_back(found, order, answers);
}

template <class Trace>
void StreamWorker::FrustaToTry::trace(const Coherence* coherence, std::size_t count,
                                      const Trace& trace) {
    EngineCounters counters;
    if (coherence == nullptr || coherence->loose) {
        trace(coherence, counters);
    } else if (count <= without_) {
        trace(coherence->scattered ? nullptr : &neighbours, counters);
        without_ -= count;
    } else {
        trace(coherence, counters);
        without_ = counters.in_frusta == 0 ? most_without : 0;
    }
}

template <class Real>
void StreamWorker::nearest_of(const RayStream<Real>& rays, const HitStream& hits) {
    to_hits_.trace(
        intake_.coherence(), rays.count, [&](const Coherence* coherence, EngineCounters& counters) {
            query_.nearest(intake_.paths(), coherence, counters,
                           is_exact() && rays.t_max != nullptr ? intake_.taken().t_limit : nullptr);
        });
    mark_unanswered(rays, hits.wants_normals());
    LeftOver left{doubtful_, unsharp_, 0, 0};
    UpperLimits limits{nullptr, rays.t_max != nullptr};
    if constexpr (std::is_same_v<Real, float>)
        limits = {rays.t_max, false};
    else if (rays.t_max != nullptr && intake_.answers_floats())
        limits = {intake_.float_t_max(), false};
    kernels().hand_over(scene_.view(), limits, intake_.taken(),
                        query_.hits().found(intake_.paths(), 0, rays.count), hits, left);
    if (hits.touching != nullptr) find_touching(rays, hits.touching);
    sharpen({unsharp_, left.unsharp_count}, hits);
    answer(rays, {doubtful_, left.doubtful_count}, hits);
    for (const std::uint32_t lane : intake_.lanes_apart())
        search(intake_.lone(rays, lane, lane), hits, lane);
    refused_ += intake_.refused();
}

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
    tracing_.method().refine.widen(scene_.view(),
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

/// Marks hits as doubtful that are not answers, or not the first: invisible sides, and hits of
/// methods that certify nothing.
template <class Real>
void StreamWorker::mark_unanswered(const RayStream<Real>& rays, bool with_normals) {
    if (scene_.looks_through()) find_surfaces(with_normals);
    const Hits& found = query_.hits();
    const auto mark = [&](std::size_t lane) { found.hit[lane] |= hit_doubtful; };
    if (is_exact()) return; // rays that meet several shapes at one point have the first
    for (const std::uint32_t lane : query_.at_contacts())
        mark(lane);
    if (rays.t_min == nullptr) return;
    for (std::size_t lane = 0; lane < rays.count; ++lane) {
        if (!intake_.is_ray(lane) || found.slot[lane] == no_slot) continue;
        const LoneRay ray = intake_.lone(rays, lane, lane);
        const double t =
            ray.by_floats ? static_cast<double>(t_at(lane, ray)) : ray.as_answered(hit_at(lane).t);
        if (t <= ray.t_min) mark(lane);
    }
}

/// Replaces hits that are not visible surfaces by the first ones that are. Marks those as doubtful
/// for which the scalar search has to find it.
void StreamWorker::find_surfaces(bool with_normals) {
    const Hits& found = query_.hits();
    const std::size_t count = intake_.paths().count;
    std::size_t hidden = 0;
    for (std::size_t lane = 0; lane < count; ++lane)
        if (found.slot[lane] != no_slot && !is_seen(lane)) {
            found.hit[lane] |= hit_doubtful;
            unsharp_[hidden++] = static_cast<std::uint32_t>(lane);
        }
    if (hidden == 0 || !expressions_.any() || !is_exact()) return;
    Found those = found.found(intake_.paths(), 0, count);
    if (!with_normals) std::fill_n(those.normal, 3, nullptr);
    tracing_.method().refine.first_surfaces(expressions_.nodes(), those, found.slot, unsharp_,
                                            hidden);
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
        const auto all =
            core::solve(table.get(hit.place), ray.ray, ray.origins.start_on(hit.shape), widened);
        return std::any_of(all.begin(), all.end(), [&](const core::Crossing<double>& crossing) {
            const core::Hit<double> other(crossing, hit.shape, hit.kind, hit.place, hit.reversed);
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

StreamWorker::Columns::Taken StreamWorker::Columns::take(std::size_t count,
                                                         const CrossingRequest& wanted) {
    const auto room = [count](auto& column) {
        column.resize(count);
        return column.data();
    };
    Taken taken;
    add_missing(taken.hits, count);
    taken.hits.touching = room(touching);
    for (int axis = 0; axis < 3; ++axis) {
        if (wanted.normals) taken.hits.normal[axis] = room(normal[axis]);
        if (wanted.normals_double) taken.normals.normal[axis] = room(normal_double[axis]);
    }
    return taken;
}

/// Adds the columns that a hit's normal as doubles depends on.
void StreamWorker::Columns::add_missing(HitStream& hits, std::size_t count) {
    const auto add = [count](auto*& wanted, auto& column) {
        if (wanted != nullptr) return;
        column.resize(count);
        wanted = column.data();
    };
    add(hits.t_double, t);
    add(hits.shape, shape);
    add(hits.entering, entering);
    add(hits.face, face);
}

template <class Real>
std::size_t StreamWorker::first_crossings(const RayStream<Real>& rays,
                                          const CrossingRequest& wanted, CrossingRows& rows) {
    std::size_t refused = 0;
    for (std::size_t first = 0, count = 0; first < rays.count; first += count) {
        count = std::min(rays.count - first, TileOrder::most);
        const auto [hits, normals] = columns_.take(count, wanted);
        refused += nearest(part_of(rays, first, count), hits, normals);
        for (std::size_t i = 0; i < count; ++i) {
            if (hits.shape[i] != core::no_shape) {
                rows.t.push_back(hits.t_double[i]);
                rows.shape.push_back(hits.shape[i]);
                rows.entering.push_back(hits.entering[i]);
                rows.face.push_back(hits.face[i]);
                rows.tied.push_back(0);
                rows.touching.push_back(hits.touching[i]);
                for (std::size_t axis = 0; wanted.normals && axis < 3; ++axis)
                    rows.normal[axis].push_back(hits.normal[axis][i]);
                for (std::size_t axis = 0; wanted.normals_double && axis < 3; ++axis)
                    rows.normal_double[axis].push_back(normals.normal[axis][i]);
            }
            rows.first.push_back(rows.t.size());
        }
    }
    return refused;
}

template <class Real>
void StreamWorker::occluded_of(const RayStream<Real>& rays, std::uint8_t* occluded) {
    // A tiny t counts by the float to which it is rounded; bounds cannot decide that.
    constexpr auto min_t = static_cast<Real>(0x1p-102);
    std::fill_n(state_, rays.count, std::uint8_t{unblocked});
    if (rays.t_max != nullptr)
        for (std::size_t lane = 0; lane < rays.count; ++lane)
            if (rays.t_max[lane] < min_t) state_[lane] = doubtful;
    for (std::size_t lane = 0; lane < rays.count; ++lane) {
        if ((intake_.paths().origin_bits[lane] & origin_may_return) != 0) state_[lane] = doubtful;
        if (!intake_.is_ray(lane)) state_[lane] = blocked;
    }
    to_occluders_.trace(intake_.coherence(), rays.count,
                        [&](const Coherence* coherence, EngineCounters& counters) {
                            query_.occluded(intake_.paths().columns(), intake_.taken().t_limit,
                                            state_, coherence, counters);
                        });
    // Without certificates, bounds cannot decide lower limits either.
    if (!is_exact() && rays.t_min != nullptr)
        for (std::size_t lane = 0; lane < rays.count; ++lane)
            if (rays.t_min[lane] > Real(0) && state_[lane] == blocked && intake_.is_ray(lane))
                state_[lane] = doubtful;
    refused_ += intake_.refused();
    std::size_t left = 0;
    for (std::size_t lane = 0; lane < rays.count; ++lane) {
        occluded[lane] = state_[lane] == blocked && intake_.is_ray(lane) ? 1 : 0;
        doubtful_[left] = static_cast<std::uint32_t>(lane);
        left += state_[lane] == doubtful && intake_.is_ray(lane) ? 1 : 0;
    }
    for (const std::uint32_t lane : intake_.lanes_apart())
        occluded[lane] = is_occluded(intake_.lone(rays, lane, lane));
    if (is_exact() && left != 0)
        settle(rays, left, occluded);
    else
        for (std::size_t k = 0; k < left; ++k)
            occluded[doubtful_[k]] = is_occluded(intake_.lone(rays, doubtful_[k], doubtful_[k]));
}

/// Decides the occlusion of doubtful rays by their first hits.
template <class Real>
void StreamWorker::settle(const RayStream<Real>& rays, std::size_t left, std::uint8_t* occluded) {
    intake_.keep(doubtful_, left);
    EngineCounters counters;
    query_.nearest(intake_.paths(), intake_.coherence() != nullptr ? &neighbours : nullptr,
                   counters, intake_.taken().t_limit);
    if (scene_.looks_through()) find_surfaces(/*with_normals=*/false);
    for (std::size_t k = 0; k < left; ++k) {
        const std::size_t i = doubtful_[k];
        occluded[i] = 0;
        if (query_.hits().slot[k] == no_slot) continue;
        const LoneRay ray = intake_.lone(rays, i, k);
        occluded[i] = (query_.hits().hit[k] & hit_doubtful) != 0 ? is_occluded(ray)
                      : is_before_t_max(k, ray)                  ? 1
                                                                 : 0;
    }
}

std::uint8_t StreamWorker::is_occluded(const LoneRay& ray) {
    std::uint8_t found = 0;
    searcher_.each(ray.ray, ray.origins, ray.t_limit, [&](const core::Hit<double>& hit) {
        found = ray.finds(scene_.scene(), hit) ? 1 : 0;
        return found == 0;
    });
    return found;
}

/// Returns true if the lane's hit is visible from the ray's side, and its shape alone answers the
/// ray: a part of a solid must be a surface of it there, and not reversed.
bool StreamWorker::is_seen(std::size_t lane) {
    const Hits& found = query_.hits();
    const SceneData::ShapeRecord shape = scene_.record_of(found.slot[lane]);
    const core::Scene& scene = scene_.scene();
    if (!scene.materials()[shape.material].is_seen(shape.is_entered(found.hit[lane]))) return false;
    return !scene.solids().has(shape.id) ||
           (!shape.reversed &&
            solid_surfaces_.is_surface(
                {ray_of(intake_.paths(), lane), origin_surfaces_of(scene_, intake_.paths(), lane)},
                hit_at(lane)));
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

template std::size_t StreamWorker::nearest(const RayStream<float>&, const HitStream&,
                                           const NormalStream&);
template std::size_t StreamWorker::nearest(const RayStream<double>&, const HitStream&,
                                           const NormalStream&);
template std::size_t StreamWorker::occluded(const RayStream<float>&, std::uint8_t*);
template std::size_t StreamWorker::occluded(const RayStream<double>&, std::uint8_t*);
template std::size_t StreamWorker::first_crossings(const RayStream<float>&, const CrossingRequest&,
                                                   CrossingRows&);
template std::size_t StreamWorker::first_crossings(const RayStream<double>&, const CrossingRequest&,
                                                   CrossingRows&);

} // namespace raylane::simd
