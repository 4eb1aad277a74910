#include "simd/stream/worker.hpp"

#include "simd/query/as_core.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>

namespace raylane::simd {

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
        const RayStream<Real> part = intake_.take(rays, first);
        count = part.count;
        if (first >= in_order && are_better_in_tiles(rays, first)) {
            const std::size_t most = std::min(rays.count - first, TileOrder::most);
            if (tiles_.find(part_of(rays, first, most), intake_.coherence()->parallel)) {
                in_tiles(first, most);
                count = most;
                continue;
            }
            in_order = first + most;
        }
        as_they_are(part, first);
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
        const RayStream<Real> part = part_of(rays, first, count);
        HitStream found = part_of(hits, first);
        columns_.add_missing(found, count);
        refused += find_nearest(part, found);
        for (std::size_t i = 0; i < count; ++i) {
            const core::Vec3d normal = double_normal_of(part, found, i);
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
        [&](const RayStream<Real>& part, std::size_t first) {
            nearest_of(part, part_of(hits, first));
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
        [&](const RayStream<Real>& part, std::size_t first) {
            occluded_of(part, occluded + first);
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
        const RayStream<Real> part = intake_.take(sorted, first);
        count = part.count;
        nearest_of(part, part_of(found, first));
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
        const RayStream<Real> part = intake_.take(sorted, first);
        count = part.count;
        occluded_of(part, found.entering + first);
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
        without_ = counters.in_frusta == 0 ? max_without : 0;
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
    kernels().hand_over(scene_.view_with_copies(), limits, intake_.taken(),
                        query_.hits().found(intake_.paths(), 0, rays.count), hits, left);
    if (hits.touching != nullptr) find_touching(rays, hits.touching);
    sharpen({unsharp_, left.unsharp_count}, hits);
    answer(rays, {doubtful_, left.doubtful_count}, hits);
    for (const std::uint32_t lane : intake_.lanes_apart())
        search(intake_.lone(rays, lane, lane), hits, lane);
    refused_ += intake_.refused();
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
    const bool by_expressions = expressions_.any() && is_exact();
    std::size_t asked = 0;
    for (std::size_t lane = 0; lane < count; ++lane)
        if (found.slot[lane] != no_slot && !is_seen(lane, !by_expressions)) {
            found.hit[lane] |= hit_doubtful;
            unsharp_[asked++] = static_cast<std::uint32_t>(lane);
        }
    if (asked == 0 || !by_expressions) return;
    Found those = found.found(intake_.paths(), 0, count);
    if (!with_normals) std::fill_n(those.normal, 3, nullptr);
    tracing_.method().refine.first_surfaces(expressions_.nodes(), those, found.slot, unsharp_,
                                            asked);
    for (std::size_t k = 0; k < asked; ++k) {
        const std::uint32_t lane = unsharp_[k];
        if (found.slot[lane] == no_slot || (found.hit[lane] & hit_doubtful) == 0) continue;
        found.hit[lane] &= ~hit_doubtful;
        if (!is_seen(lane, true)) found.hit[lane] |= hit_doubtful;
    }
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
/// ray: a part of a solid must be a surface of it there, and not reversed, or counts as unseen
/// if not `on_solids`.
bool StreamWorker::is_seen(std::size_t lane, bool on_solids) {
    const Hits& found = query_.hits();
    const SceneData::ShapeRecord shape = scene_.record_of(found.slot[lane]);
    const core::Scene& scene = scene_.scene();
    if (!scene.materials()[shape.material].is_seen(shape.is_entered(found.hit[lane]))) return false;
    return !scene.solids().has(shape.id) ||
           (on_solids && !shape.reversed &&
            solid_surfaces_.is_surface(
                {ray_of(intake_.paths(), lane), origin_surfaces_of(scene_, intake_.paths(), lane)},
                hit_at(lane)));
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
