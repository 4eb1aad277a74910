#include "simd/stream_tracer.hpp"

#include "core/reference/search.hpp"
#include "simd/query/as_core.hpp"
#include "simd/query/query.hpp"
#include "simd/threads.hpp"
#include "simd/tile_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

namespace raylane::simd {

namespace {

using core::Hit;
using core::Vec3d;
using Searcher = core::Searcher<double>;

/// A ray of a stream by itself: in double, with what it leaves, and its limits as they were given.
struct LoneRay {
    core::Ray<double> ray;
    core::OriginSurfaces<double> origins;
    int exponent; ///< the caller's t is ours times 2^exponent
    double t_min, t_max;
    bool by_floats; ///< these compare with the float nearest to t
    double t_most;  ///< no crossing counts from here on

    core::LeavingRay leaving() const { return {ray, origins}; }

    /// A crossing's t for the caller.
    float t_of(const core::Scene& scene, const Hit<double>& hit) const {
        return core::rounded_t(scene, leaving(), hit, exponent);
    }
    double double_t_of(const core::Scene& scene, const Hit<double>& hit) const {
        return as_answered(core::nearest_double_t(scene, leaving(), hit));
    }
    double as_answered(double t) const {
        return std::clamp(std::ldexp(t, exponent), std::numeric_limits<double>::denorm_min(),
                          std::numeric_limits<double>::max());
    }
    /// True if it counts: between the limits, and where it can be seen.
    bool finds(const core::Scene& scene, const Hit<double>& hit) const {
        return scene.material_of(hit.shape).is_seen(hit.entering) && is_behind_t_min(scene, hit) &&
               is_before_t_max(scene, hit);
    }
    bool is_before_t_max(const core::Scene& scene, const Hit<double>& hit) const {
        if (t_most == std::numeric_limits<double>::infinity()) return true;
        return by_floats ? static_cast<double>(t_of(scene, hit)) <= t_max
                         : compare_t(scene, hit, t_max) <= 0;
    }

  private:
    bool is_behind_t_min(const core::Scene& scene, const Hit<double>& hit) const {
        if (!(t_min > 0.0)) return true;
        return by_floats ? static_cast<double>(t_of(scene, hit)) > t_min
                         : compare_t(scene, hit, t_min) > 0;
    }
    int compare_t(const core::Scene& scene, const Hit<double>& hit, double limit) const {
        return core::compare_t(scene, leaving(), hit, std::ldexp(limit, -exponent));
    }
};

bool wants_normals(const HitStream& hits) {
    return hits.normal[0] != nullptr || hits.normal[1] != nullptr || hits.normal[2] != nullptr;
}

/// Normal in float, where 0 has one sign.
core::Vec3f in_float(const Vec3d& normal) {
    return core::convert<float>(normal) + core::Vec3f(0.0F);
}

template <class Value>
Value* from(Value* values, std::size_t first) {
    return values != nullptr ? values + first : nullptr;
}

/// `count` of them, from one on.
template <class Real>
RayStream<Real> part_of(const RayStream<Real>& rays, std::size_t first, std::size_t count) {
    const auto part = [first](const Real* const(&from_all)[3], int axis) {
        return from(from_all[axis], first);
    };
    return {count,
            {part(rays.origin, 0), part(rays.origin, 1), part(rays.origin, 2)},
            {part(rays.direction, 0), part(rays.direction, 1), part(rays.direction, 2)},
            from(rays.t_min, first),
            from(rays.t_max, first),
            from(rays.origin_shape, first),
            from(rays.origin_face, first),
            from(rays.origin_inward, first)};
}

HitStream part_of(const HitStream& hits, std::size_t first) {
    return {from(hits.t, first),
            {from(hits.normal[0], first), from(hits.normal[1], first), from(hits.normal[2], first)},
            from(hits.shape, first),
            from(hits.entering, first),
            from(hits.face, first),
            from(hits.t_double, first)};
}

void store(const HitStream& hits, std::size_t i, float t, double t_double,
           const core::Vec3f& normal, core::ShapeId shape, bool entering, core::Face face) {
    if (hits.t != nullptr) hits.t[i] = t;
    if (hits.t_double != nullptr) hits.t_double[i] = t_double;
    for (int axis = 0; axis < 3; ++axis)
        if (hits.normal[axis] != nullptr) hits.normal[axis][i] = normal[axis];
    if (hits.shape != nullptr) hits.shape[i] = shape;
    if (hits.entering != nullptr) hits.entering[i] = entering ? 1 : 0;
    if (hits.face != nullptr) hits.face[i] = face;
}

void store_none(const HitStream& hits, std::size_t i) {
    store(hits, i, std::numeric_limits<float>::infinity(), std::numeric_limits<double>::infinity(),
          core::Vec3f(0.0F), core::no_shape, false, core::body);
}

/// Columns from lane `to` on, a multiple of 16.
StreamRays from(StreamRays rays, std::size_t to) {
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] += to;
        rays.direction[axis] += to;
        rays.meant_direction[axis] += to;
    }
    for (double** const column :
         {&rays.meant_length, &rays.unit, &rays.per_unit, &rays.t_after, &rays.start, &rays.t_most})
        *column += to;
    rays.bits += to;
    return rays;
}

CallerHits as_kernels_have_them(const HitStream& hits) {
    return {hits.t,     hits.t_double, {hits.normal[0], hits.normal[1], hits.normal[2]},
            hits.shape, hits.entering, hits.face};
}

template <class Real>
CallerRays<Real> as_kernels_have_them(const RayStream<Real>& rays) {
    return {rays.count,
            {rays.origin[0], rays.origin[1], rays.origin[2]},
            {rays.direction[0], rays.direction[1], rays.direction[2]},
            rays.t_min,
            rays.t_max};
}

/// Rays and hits by another order than the caller's.
class TileColumns {
  public:
    template <class Real>
    struct Sorted {
        RayStream<Real> rays;
        HitStream hits;
    };

    /// Puts rays in this order, and makes room for the hits that are wanted.
    template <class Real>
    Sorted<Real> take(const RayStream<Real>& rays, const HitStream& hits,
                      std::span<const std::uint32_t> order) {
        bytes_.resize(TileOrder::most * bytes_a_ray);
        next_ = bytes_.data();
        Sorted<Real> sorted{};
        sorted.rays.count = order.size();
        sorted.hits.t_double = room_for(hits.t_double, order.size());
        for (int axis = 0; axis < 3; ++axis) {
            sorted.rays.origin[axis] = gathered(rays.origin[axis], order);
            sorted.rays.direction[axis] = gathered(rays.direction[axis], order);
        }
        sorted.rays.t_min = gathered(rays.t_min, order);
        sorted.rays.t_max = gathered(rays.t_max, order);
        sorted.hits.t = room_for(hits.t, order.size());
        for (int axis = 0; axis < 3; ++axis)
            sorted.hits.normal[axis] = room_for(hits.normal[axis], order.size());
        sorted.hits.shape = room_for(hits.shape, order.size());
        sorted.hits.entering = room_for(hits.entering, order.size());
        sorted.hits.face = room_for(hits.face, order.size());
        return sorted;
    }

    /// Writes hits to where they were asked for.
    static void hand_back(const HitStream& sorted, std::span<const std::uint32_t> order,
                          const HitStream& hits) {
        scatter(sorted.t, order, hits.t);
        for (int axis = 0; axis < 3; ++axis)
            scatter(sorted.normal[axis], order, hits.normal[axis]);
        scatter(sorted.shape, order, hits.shape);
        scatter(sorted.entering, order, hits.entering);
        scatter(sorted.face, order, hits.face);
        scatter(sorted.t_double, order, hits.t_double);
    }

  private:
    /// Of 8 columns of rays and all of hits.
    static constexpr std::size_t bytes_a_ray = 9 * sizeof(double) + 5 * sizeof(float) + 2;

    template <class Value>
    Value* room(std::size_t count) {
        auto* const values = reinterpret_cast<Value*>(next_);
        next_ += count * sizeof(Value);
        return values;
    }
    template <class Value>
    Value* room_for(const Value* wanted, std::size_t count) {
        return wanted != nullptr ? room<Value>(count) : nullptr;
    }
    template <class Value>
    const Value* gathered(const Value* from, std::span<const std::uint32_t> order) {
        if (from == nullptr) return nullptr;
        auto* const to = room<Value>(order.size());
        for (std::size_t k = 0; k < order.size(); ++k)
            to[k] = from[order[k]];
        return to;
    }
    template <class Value>
    static void scatter(const Value* from, std::span<const std::uint32_t> order, Value* to) {
        if (to == nullptr) return;
        for (std::size_t k = 0; k < order.size(); ++k)
            to[order[k]] = from[k];
    }

    std::vector<std::byte> bytes_;
    std::byte* next_ = nullptr;
};

} // namespace

/// Answers up to some rays at a time, for one thread.
class StreamTracer::Worker {
  public:
    Worker(const StreamTracer& tracer, std::size_t capacity)
        : tracer_(tracer), scene_(tracer.scene_), data_(*tracer.data_), tracing_(tracer.tracing_),
          capacity_(capacity),
          searcher_(tracer.scene_, core::Search::hierarchy, tracing_.precision),
          query_(data_, tracing_, Asked::floats) {
        arena_ = arena_for([&](Arena& arena) { take_from(arena); });
    }

    template <class Real>
    void nearest(const RayStream<Real>& rays, const HitStream& hits) {
        std::size_t in_order = 0; // until there, rays have been found to be in a good order
        for (std::size_t first = 0, count = 0; first < rays.count; first += count) {
            const RayStream<Real> some = take(rays, first);
            count = some.count;
            if (first >= in_order && are_better_in_tiles(rays, first)) {
                const std::size_t most = std::min(rays.count - first, TileOrder::most);
                if (is_order_found(rays, first, most)) {
                    nearest_in_tiles(part_of(rays, first, most), part_of(hits, first));
                    count = most;
                    continue;
                }
                in_order = first + most;
            }
            nearest_of(some, part_of(hits, first));
        }
    }

    template <class Real>
    void occluded(const RayStream<Real>& rays, std::uint8_t* occluded) {
        for (std::size_t first = 0, count = 0; first < rays.count; first += count) {
            const RayStream<Real> some = take(rays, first);
            count = some.count;
            occluded_of(some, occluded + first);
        }
    }

  private:
    bool is_exact() const { return tracing_.precision == core::Precision::exact; }
    const StreamKernels& kernels() const { return tracing_.kernels->stream; }

    void take_from(Arena& arena) {
        query_.take_from(arena, capacity_);
        paths_.take_from(arena, capacity_, false, /*for_others=*/true);
        taken_ = {{paths_.origin[0], paths_.origin[1], paths_.origin[2]},
                  {paths_.direction[0], paths_.direction[1], paths_.direction[2]},
                  {paths_.meant_direction[0], paths_.meant_direction[1], paths_.meant_direction[2]},
                  paths_.meant_length,
                  arena.take<double>(capacity_),
                  arena.take<double>(capacity_),
                  paths_.t_after,
                  paths_.start,
                  arena.take<double>(capacity_),
                  paths_.origin_bits};
        doubtful_ = arena.take<std::uint32_t>(capacity_);
        unsharp_ = arena.take<std::uint32_t>(capacity_);
        state_ = arena.take<std::uint8_t>(capacity_);
    }

    /// Takes rays in from `first` on: as many as are best answered together. Returns these.
    template <class Real>
    RayStream<Real> take(const RayStream<Real>& rays, std::size_t first) {
        paths_.t_after = taken_.t_after;
        paths_.start = taken_.start;
        const std::size_t left = rays.count - first;
        std::size_t count = std::min(left, together);
        take(part_of(rays, first, count), count, 0);
        const bool coherent =
            is_exact() && kernels().find_coherence(count, taken_, data_.radius(), in_common_);
        coherence_ = coherent ? &in_common_ : nullptr;
        if (!coherent && count < std::min(left, capacity_)) {
            const std::size_t more = std::min(left, capacity_) - count;
            take(part_of(rays, first + count, more), more, count);
            count += more;
        }
        // Limits below are for who certifies; the others look at what they have found.
        if (!is_exact() || rays.t_min == nullptr) paths_.t_after = paths_.start = nullptr;
        paths_.count = count;
        return part_of(rays, first, count);
    }

    /// True if it is worth to look whether the rays taken last, and those behind them, are.
    template <class Real>
    bool are_better_in_tiles(const RayStream<Real>& rays, std::size_t first) const {
        return coherence_ != nullptr && !coherence_->loose && !coherence_->converging &&
               data_.best_in_tiles() && rays.origin_shape == nullptr &&
               rays.count - first >= TileOrder::least;
    }

    template <class Real>
    bool is_order_found(const RayStream<Real>& rays, std::size_t first, std::size_t count) {
        const RayStream<Real> some = part_of(rays, first, count);
        return tiles_.find(some.origin, some.direction, count, in_common_.parallel);
    }

    /// Rays in the order that has been found for them.
    template <class Real>
    void nearest_in_tiles(const RayStream<Real>& rays, const HitStream& hits) {
        const std::span<const std::uint32_t> order = tiles_.order();
        const auto [sorted, found] = tile_columns_.take(rays, hits, order);
        for (std::size_t first = 0; first < sorted.count; first += paths_.count) {
            const RayStream<Real> some = take(sorted, first);
            nearest_of(some, part_of(found, first));
        }
        TileColumns::hand_back(found, order, hits);
    }

    /// All of them, from lane `to` on.
    template <class Real>
    void take(const RayStream<Real>& rays, std::size_t count, std::size_t to) {
        std::size_t none = 0;
        if constexpr (std::is_same_v<Real, float>)
            none = kernels().take(as_kernels_have_them(rays), from(taken_, to));
        else
            none = kernels().take_doubles(as_kernels_have_them(rays), from(taken_, to));
        if (rays.origin_shape == nullptr)
            for (std::uint32_t* const column :
                 {paths_.origin_first, paths_.origin_last, paths_.origin_slot})
                std::fill_n(column + to, count, no_slot);
        else
            start_on(rays, tracer_.slots_by_id(), count, to);
        if (none != 0) stand_in(to, to + count);
    }

    template <class Real>
    void start_on(const RayStream<Real>& rays, std::span<const std::uint32_t> slots,
                  std::size_t count, std::size_t to) {
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t lane = to + i;
            const core::ShapeId shape = rays.origin_shape[i];
            const std::uint32_t tie_counts = paths_.origin_bits[lane];
            const std::uint32_t slot = shape < slots.size() ? slots[shape] : no_slot;
            if (slot == no_slot) {
                paths_.start_nowhere(lane, lane + 1);
            } else {
                const bool inward = rays.origin_inward != nullptr && rays.origin_inward[i] != 0;
                const std::uint32_t face = rays.origin_face != nullptr ? rays.origin_face[i] : 0;
                paths_.start_on(lane, slot, data_.shape_named(shape, slot),
                                face | (inward ? hit_entering : 0), /*through=*/true);
            }
            paths_.origin_bits[lane] |= tie_counts;
        }
    }

    /// Lanes without a ray get that of another lane, so that those around them have still in common
    /// what they had.
    void stand_in(std::size_t begin, std::size_t end) {
        std::size_t other = begin;
        while (other < end && !is_ray(other))
            ++other;
        if (other == end) return;
        for (std::size_t lane = begin; lane < end; ++lane)
            if (is_ray(lane))
                other = lane;
            else
                paths_.copy_ray(paths_, other, lane);
    }

    bool is_ray(std::size_t lane) const { return taken_.t_most[lane] >= 0.0; }

    template <class Real>
    void nearest_of(const RayStream<Real>& rays, const HitStream& hits) {
        EngineCounters counters;
        query_.nearest(paths_, coherence_, counters,
                       is_exact() && rays.t_max != nullptr ? taken_.t_most : nullptr);
        mark_unanswered(rays);
        const Hits& found = query_.hits();
        LeftOver left{doubtful_, unsharp_, 0, 0};
        kernels().hand_over(data_.view(), rays.count, limits_of(rays), taken_,
                            {found.slot,
                             found.hit,
                             found.t,
                             found.error,
                             {found.normal[0], found.normal[1], found.normal[2]}},
                            as_kernels_have_them(hits), left);
        sharpen({unsharp_, left.unsharp_count}, hits);
        for (std::size_t k = 0; k < left.doubtful_count; ++k)
            answer(rays, doubtful_[k], hits);
    }

    static UpperLimits limits_of(const RayStream<float>& rays) { return {rays.t_max, false}; }
    static UpperLimits limits_of(const RayStream<double>& rays) {
        return {nullptr, rays.t_max != nullptr};
    }

    /// t in double of lanes that have hits.
    void sharpen(std::span<const std::uint32_t> lanes, const HitStream& hits) {
        const Hits& found = query_.hits();
        if (!is_exact()) {
            for (const std::uint32_t lane : lanes)
                hits.t_double[lane] = in_double(lane, found.t[lane] / paths_.length_of(lane));
            return;
        }
        constexpr std::size_t at_a_time = 128;
        std::size_t places[at_a_time];
        double high[at_a_time], low[at_a_time], error[at_a_time];
        for (std::size_t first = 0; first < lanes.size(); first += at_a_time) {
            const auto some = lanes.subspan(first, std::min(at_a_time, lanes.size() - first));
            std::copy(some.begin(), some.end(), places);
            tracing_.method().refine.widen(data_.view(), found.found(paths_, 0, paths_.count),
                                           places, some.size(), {high, low, error});
            for (std::size_t k = 0; k < some.size(); ++k) {
                const std::uint32_t lane = some[k];
                const bool is_sure = core::rounds_surely({high[k], low[k]}, error[k]);
                hits.t_double[lane] = in_double(
                    lane, is_sure
                              ? high[k]
                              : core::nearest_double_t(
                                    scene_,
                                    {ray_of(paths_, lane), origin_surfaces_of(data_, paths_, lane)},
                                    hit_of(data_, paths_, found, lane)));
            }
        }
    }

    /// The caller's t for one of the lane's.
    double in_double(std::size_t lane, double t) const {
        return std::clamp(t * taken_.unit[lane], std::numeric_limits<double>::denorm_min(),
                          std::numeric_limits<double>::max());
    }

    /// Marks hits that are none, or not the first, as doubtful: sides that cannot be seen, and what
    /// a method finds that certifies nothing.
    template <class Real>
    void mark_unanswered(const RayStream<Real>& rays) {
        const Hits& found = query_.hits();
        const auto mark = [&](std::size_t lane) { found.hit[lane] |= hit_doubtful; };
        if (data_.one_sided())
            for (std::size_t lane = 0; lane < rays.count; ++lane)
                if (found.slot[lane] != no_slot && !is_seen(lane)) mark(lane);
        if (is_exact()) return; // what meets several shapes at one point has the first
        for (const std::uint32_t lane : query_.at_contacts())
            mark(lane);
        if (rays.t_min == nullptr) return;
        for (std::size_t lane = 0; lane < rays.count; ++lane)
            if (is_ray(lane) && found.slot[lane] != no_slot &&
                static_cast<double>(t_at(lane, lone(rays, lane, lane))) <=
                    static_cast<double>(rays.t_min[lane]))
                mark(lane);
    }

    /// Answer to one ray, by the scalar search or, where only floats are in doubt, by what has been
    /// found.
    template <class Real>
    void answer(const RayStream<Real>& rays, std::size_t lane, const HitStream& hits) {
        const LoneRay ray = lone(rays, lane, lane);
        const Hits& found = query_.hits();
        if ((found.hit[lane] & hit_doubtful) != 0) return search(ray, hits, lane);
        if (!is_before_t_max(lane, ray)) return store_none(hits, lane);
        const auto t_double = [&] {
            return ray.double_t_of(scene_, hit_of(data_, paths_, found, lane));
        };
        store(hits, lane, t_at(lane, ray), hits.t_double != nullptr ? t_double() : 0.0,
              wants_normals(hits) ? normal_at(lane, ray) : core::Vec3f(0.0F),
              data_.id_of(found.slot[lane]), (found.hit[lane] & hit_entering) != 0,
              static_cast<core::Face>(found.hit[lane] & hit_face));
    }

    /// Of the lane's hit.
    bool is_before_t_max(std::size_t lane, const LoneRay& ray) const {
        return ray.by_floats
                   ? static_cast<double>(t_at(lane, ray)) <= ray.t_max
                   : ray.is_before_t_max(scene_, hit_of(data_, paths_, query_.hits(), lane));
    }

    /// The scalar search for one ray.
    void search(const LoneRay& ray, const HitStream& hits, std::size_t i) {
        const auto counts = [&](const Hit<double>& hit) { return ray.finds(scene_, hit); };
        const Hit<double> hit = searcher_.nearest(ray.ray, ray.origins, counts, ray.t_most).hit;
        if (!hit.any()) return store_none(hits, i);
        core::Vec3f normal(0.0F);
        if (wants_normals(hits))
            normal = is_exact() ? core::rounded_normal(scene_, ray.leaving(), hit)
                                : in_float(searcher_.surface_at(ray.ray, ray.origins, hit).normal);
        const double t_double = hits.t_double == nullptr ? 0.0
                                : is_exact()             ? ray.double_t_of(scene_, hit)
                                                         : ray.as_answered(hit.t);
        store(hits, i, ray.t_of(scene_, hit), t_double, normal, hit.shape, hit.entering, hit.face);
    }

    template <class Real>
    void occluded_of(const RayStream<Real>& rays, std::uint8_t* occluded) {
        // A t that is none until rounded is no matter for bounds.
        constexpr auto least_t = static_cast<Real>(0x1p-102);
        std::fill_n(state_, rays.count, std::uint8_t{unblocked});
        if (rays.t_max != nullptr)
            for (std::size_t lane = 0; lane < rays.count; ++lane)
                if (rays.t_max[lane] < least_t) state_[lane] = doubtful;
        for (std::size_t lane = 0; lane < rays.count; ++lane) {
            if ((paths_.origin_bits[lane] & origin_may_return) != 0) state_[lane] = doubtful;
            if (!is_ray(lane)) state_[lane] = blocked;
        }
        EngineCounters counters;
        query_.occluded(paths_.columns(), taken_.t_most, state_, coherence_, counters);
        // Nor is a limit from below where nothing is certified.
        if (!is_exact() && rays.t_min != nullptr)
            for (std::size_t lane = 0; lane < rays.count; ++lane)
                if (rays.t_min[lane] > Real(0) && state_[lane] == blocked && is_ray(lane))
                    state_[lane] = doubtful;
        std::size_t left = 0;
        for (std::size_t lane = 0; lane < rays.count; ++lane) {
            occluded[lane] = state_[lane] == blocked && is_ray(lane) ? 1 : 0;
            doubtful_[left] = static_cast<std::uint32_t>(lane);
            left += state_[lane] == doubtful ? 1 : 0;
        }
        if (left == 0) return;
        if (is_exact())
            settle(rays, left, occluded);
        else
            for (std::size_t k = 0; k < left; ++k)
                occluded[doubtful_[k]] = is_occluded(lone(rays, doubtful_[k], doubtful_[k]));
    }

    /// Occlusion of doubtful rays by what they hit first.
    template <class Real>
    void settle(const RayStream<Real>& rays, std::size_t left, std::uint8_t* occluded) {
        for (std::size_t k = 0; k < left; ++k) {
            paths_.copy_ray(paths_, doubtful_[k], k);
            taken_.unit[k] = taken_.unit[doubtful_[k]];
            taken_.t_most[k] = taken_.t_most[doubtful_[k]];
        }
        paths_.count = left;
        EngineCounters counters;
        query_.nearest(paths_, coherence_ != nullptr ? &neighbours : nullptr, counters,
                       taken_.t_most);
        for (std::size_t k = 0; k < left; ++k) {
            const std::size_t i = doubtful_[k];
            occluded[i] = 0;
            if (query_.hits().slot[k] == no_slot) continue;
            const LoneRay ray = lone(rays, i, k);
            occluded[i] = data_.one_sided() && !is_seen(k) ? is_occluded(ray)
                          : is_before_t_max(k, ray)        ? 1
                                                           : 0;
        }
    }

    std::uint8_t is_occluded(const LoneRay& ray) {
        std::uint8_t found = 0;
        searcher_.each(ray.ray, ray.origins, ray.t_most, [&](const Hit<double>& hit) {
            found = ray.finds(scene_, hit) ? 1 : 0;
            return found == 0;
        });
        return found;
    }

    /// Ray i, which is in some lane.
    template <class Real>
    LoneRay lone(const RayStream<Real>& rays, std::size_t i, std::size_t lane) const {
        const double unit = taken_.unit[lane];
        constexpr Real endless = std::numeric_limits<Real>::infinity();
        const Real t_min = rays.t_min != nullptr ? std::max(Real(0), rays.t_min[i]) : Real(0);
        const Real t_max = rays.t_max != nullptr ? rays.t_max[i] : endless;
        const auto beyond = static_cast<double>(std::nextafter(t_max, endless));
        return {ray_of(paths_, lane),
                origin_surfaces_of(data_, paths_, lane),
                std::ilogb(unit),
                static_cast<double>(t_min),
                static_cast<double>(t_max),
                std::is_same_v<Real, float>,
                t_max < std::numeric_limits<Real>::max() ? beyond / unit
                                                         : std::numeric_limits<double>::infinity()};
    }

    /// True if the lane's hit can be seen from where the ray comes.
    bool is_seen(std::size_t lane) const {
        const Hits& found = query_.hits();
        const core::MaterialIndex material = data_.occupant_of(found.slot[lane]).material;
        return scene_.materials()[material].is_seen((found.hit[lane] & hit_entering) != 0);
    }

    /// t of the lane's hit, for the caller.
    float t_at(std::size_t lane, const LoneRay& ray) const {
        const Hits& found = query_.hits();
        const double per_unit = taken_.unit[lane] / paths_.length_of(lane);
        const double t = found.t[lane] * per_unit;
        float rounded = 0.0F;
        // The length and both operations are off by a few ulps.
        const double error = found.error[lane] * per_unit * (1.0 + 0x1p-50) + 0x1p-50 * t;
        if (core::rounds_surely(t, is_exact() ? error : 0.0, rounded)) return rounded;
        return ray.t_of(scene_, hit_of(data_, paths_, found, lane));
    }

    core::Vec3f normal_at(std::size_t lane, const LoneRay& ray) const {
        const Hits& found = query_.hits();
        if ((found.hit[lane] & (hit_normal_doubtful | hit_normal_unknown)) != 0)
            return core::rounded_normal(scene_, ray.leaving(), hit_of(data_, paths_, found, lane));
        return in_float({found.normal[0][lane], found.normal[1][lane], found.normal[2][lane]});
    }

    /// Rays that are looked at for what they have in common.
    static constexpr std::size_t together = 1024;

    const StreamTracer& tracer_;
    const core::Scene& scene_;
    const SceneData& data_;
    Tracing tracing_;
    std::size_t capacity_;
    Searcher searcher_;
    Query query_;
    Arena arena_;
    Paths paths_{};
    StreamRays taken_{}; // their columns, and those of limits
    Coherence in_common_{};
    TileOrder tiles_;
    TileColumns tile_columns_;
    const Coherence* coherence_ = nullptr;
    std::uint32_t* doubtful_ = nullptr; // lanes
    std::uint32_t* unsharp_ = nullptr;
    std::uint8_t* state_ = nullptr;
};

/// A worker as long as it is used.
class StreamTracer::Lease {
  public:
    explicit Lease(const StreamTracer& tracer) : tracer_(tracer) {
        {
            const std::lock_guard lock(tracer.mutex_);
            if (!tracer.idle_.empty()) {
                worker_ = std::move(tracer.idle_.back());
                tracer.idle_.pop_back();
            }
        }
        if (worker_ == nullptr) worker_ = std::make_unique<Worker>(tracer, tracer.at_a_time());
    }
    ~Lease() {
        const std::lock_guard lock(tracer_.mutex_);
        try {
            tracer_.idle_.push_back(std::move(worker_));
        } catch (const std::bad_alloc&) { // one less to keep
        }
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

    Worker& operator*() const { return *worker_; }

  private:
    const StreamTracer& tracer_;
    std::unique_ptr<Worker> worker_;
};

StreamTracer::StreamTracer(const core::Scene& scene, int threads, Isa isa,
                           core::Precision precision)
    : scene_(scene), threads_(threads),
      data_(std::make_unique<const SceneData>(scene, Transmissive::blocks)), tracing_{
                                                                                 &kernels_of(isa),
                                                                                 precision} {}

StreamTracer::~StreamTracer() = default;

std::size_t StreamTracer::at_a_time() const {
    return tracing_.precision == core::Precision::exact ? data_->best_ray_count() : fewest;
}

/// Calls answer(worker, first, count) for ranges that together are all rays.
template <class Answer>
void StreamTracer::answer(std::size_t count, const Answer& answer) const {
    if (count == 0) return;
    // All threads get some of what there is.
    const int threads = threads_ > 0 ? threads_ : default_threads();
    const std::size_t share = count / (std::size_t{4} * static_cast<std::size_t>(threads));
    const std::size_t range = std::max(share / fewest * fewest, fewest);
    if (threads == 1 || count <= range) {
        const Lease worker(*this);
        answer(*worker, 0, count);
        return;
    }
    on_threads(threads_, [&] {
        parallel_for((count + range - 1) / range, [&](std::size_t number) {
            const Lease worker(*this);
            const std::size_t first = number * range;
            answer(*worker, first, std::min(range, count - first));
        });
    });
}

template <class Real>
void StreamTracer::nearest(const RayStream<Real>& rays, const HitStream& hits) const {
    answer(rays.count, [&](Worker& worker, std::size_t first, std::size_t count) {
        worker.nearest(part_of(rays, first, count), part_of(hits, first));
    });
}

template <class Real>
void StreamTracer::occluded(const RayStream<Real>& rays, std::uint8_t* occluded) const {
    answer(rays.count, [&](Worker& worker, std::size_t first, std::size_t count) {
        worker.occluded(part_of(rays, first, count), occluded + first);
    });
}

template void StreamTracer::nearest(const RayStream<float>&, const HitStream&) const;
template void StreamTracer::nearest(const RayStream<double>&, const HitStream&) const;
template void StreamTracer::occluded(const RayStream<float>&, std::uint8_t*) const;
template void StreamTracer::occluded(const RayStream<double>&, std::uint8_t*) const;

std::span<const std::uint32_t> StreamTracer::slots_by_id() const {
    std::call_once(has_slots_, [&] { slots_ = data_->slots_by_id(); });
    return slots_;
}

} // namespace raylane::simd
