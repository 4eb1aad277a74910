#include "simd/stream_tracer.hpp"

#include "core/reference/search.hpp"
#include "simd/query/as_core.hpp"
#include "simd/query/query.hpp"
#include "simd/threads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
    float t_min, t_max;
    double t_most; ///< no crossing counts from here on

    core::LeavingRay leaving() const { return {ray, origins}; }

    /// A crossing's t for the caller.
    float t_of(const core::Scene& scene, const Hit<double>& hit) const {
        return core::rounded_t(scene, leaving(), hit, exponent);
    }
    /// True if it counts: between the limits, and where it can be seen.
    bool finds(const core::Scene& scene, const Hit<double>& hit) const {
        if (!scene.material_of(hit.shape).is_seen(hit.entering)) return false;
        if (!(t_min > 0.0F || t_max < std::numeric_limits<float>::max())) return true;
        const float t = t_of(scene, hit);
        return t_min < t && t <= t_max;
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
RayStream part_of(const RayStream& rays, std::size_t first, std::size_t count) {
    const auto part = [first](const float* const(&from_all)[3], int axis) {
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
            from(hits.face, first)};
}

void store(const HitStream& hits, std::size_t i, float t, const core::Vec3f& normal,
           core::ShapeId shape, bool entering, core::Face face) {
    if (hits.t != nullptr) hits.t[i] = t;
    for (int axis = 0; axis < 3; ++axis)
        if (hits.normal[axis] != nullptr) hits.normal[axis][i] = normal[axis];
    if (hits.shape != nullptr) hits.shape[i] = shape;
    if (hits.entering != nullptr) hits.entering[i] = entering ? 1 : 0;
    if (hits.face != nullptr) hits.face[i] = face;
}

void store_none(const HitStream& hits, std::size_t i) {
    store(hits, i, std::numeric_limits<float>::infinity(), core::Vec3f(0.0F), core::no_shape, false,
          core::body);
}

/// Columns from lane `to` on, a multiple of 16.
StreamRays from(StreamRays rays, std::size_t to) {
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] += to;
        rays.direction[axis] += to;
        rays.meant_direction[axis] += to;
    }
    for (double** const column :
         {&rays.meant_length, &rays.unit, &rays.t_after, &rays.start, &rays.t_most})
        *column += to;
    rays.bits += to;
    return rays;
}

CallerRays as_kernels_have_them(const RayStream& rays) {
    return {rays.count,
            {rays.origin[0], rays.origin[1], rays.origin[2]},
            {rays.direction[0], rays.direction[1], rays.direction[2]},
            rays.t_min,
            rays.t_max};
}

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

    void nearest(const RayStream& rays, const HitStream& hits) {
        for (std::size_t first = 0; first < rays.count; first += paths_.count) {
            const RayStream some = take(rays, first);
            nearest_of(some, part_of(hits, first));
        }
    }

    void occluded(const RayStream& rays, std::uint8_t* occluded) {
        for (std::size_t first = 0, count = 0; first < rays.count; first += count) {
            const RayStream some = take(rays, first);
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
                  paths_.t_after,
                  paths_.start,
                  arena.take<double>(capacity_),
                  paths_.origin_bits};
        doubtful_ = arena.take<std::uint32_t>(capacity_);
        state_ = arena.take<std::uint8_t>(capacity_);
    }

    /// Takes rays in from `first` on: as many as are best answered together. Returns these.
    RayStream take(const RayStream& rays, std::size_t first) {
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

    /// All of them, from lane `to` on.
    void take(const RayStream& rays, std::size_t count, std::size_t to) {
        const std::size_t none = kernels().take(as_kernels_have_them(rays), from(taken_, to));
        if (rays.origin_shape == nullptr)
            for (std::uint32_t* const column :
                 {paths_.origin_first, paths_.origin_last, paths_.origin_slot})
                std::fill_n(column + to, count, no_slot);
        else
            for (std::size_t i = 0; i < count; ++i)
                start_on(rays, i, to + i);
        if (none != 0) stand_in(to, to + count);
    }

    void start_on(const RayStream& rays, std::size_t i, std::size_t lane) {
        const std::uint32_t tie_counts = paths_.origin_bits[lane];
        const std::uint32_t slot = tracer_.slot_of(rays.origin_shape[i]);
        if (slot == no_slot) {
            paths_.start_nowhere(lane, lane + 1);
        } else {
            const bool inward = rays.origin_inward != nullptr && rays.origin_inward[i] != 0;
            const std::uint32_t face = rays.origin_face != nullptr ? rays.origin_face[i] : 0;
            paths_.start_on(lane, slot, data_.occupant_of(slot), face | (inward ? hit_entering : 0),
                            /*through=*/true);
        }
        paths_.origin_bits[lane] |= tie_counts;
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

    void nearest_of(const RayStream& rays, const HitStream& hits) {
        EngineCounters counters;
        query_.nearest(paths_, coherence_, counters,
                       is_exact() && rays.t_max != nullptr ? taken_.t_most : nullptr);
        mark_unanswered(rays);
        const Hits& found = query_.hits();
        const std::size_t doubtful =
            kernels().hand_over(data_.view(), as_kernels_have_them(rays), taken_,
                                {found.slot,
                                 found.hit,
                                 found.t,
                                 found.error,
                                 {found.normal[0], found.normal[1], found.normal[2]}},
                                {hits.t,
                                 {hits.normal[0], hits.normal[1], hits.normal[2]},
                                 hits.shape,
                                 hits.entering,
                                 hits.face},
                                doubtful_);
        for (std::size_t k = 0; k < doubtful; ++k)
            answer(rays, doubtful_[k], hits);
    }

    /// Marks hits that are none, or not the first, as doubtful: sides that cannot be seen, and what
    /// a method finds that certifies nothing.
    void mark_unanswered(const RayStream& rays) {
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
                t_at(lane, lone(rays, lane, lane)) <= rays.t_min[lane])
                mark(lane);
    }

    /// Answer to one ray, by the scalar search or, where only floats are in doubt, by what has been
    /// found.
    void answer(const RayStream& rays, std::size_t lane, const HitStream& hits) {
        const LoneRay ray = lone(rays, lane, lane);
        const Hits& found = query_.hits();
        if ((found.hit[lane] & hit_doubtful) != 0) return search(ray, hits, lane);
        const float t = t_at(lane, ray);
        if (!(t <= ray.t_max)) return store_none(hits, lane);
        store(hits, lane, t, wants_normals(hits) ? normal_at(lane, ray) : core::Vec3f(0.0F),
              data_.id_of(found.slot[lane]), (found.hit[lane] & hit_entering) != 0,
              static_cast<core::Face>(found.hit[lane] & hit_face));
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
        store(hits, i, ray.t_of(scene_, hit), normal, hit.shape, hit.entering, hit.face);
    }

    void occluded_of(const RayStream& rays, std::uint8_t* occluded) {
        // A t that is none until rounded is no matter for bounds.
        constexpr float least_t = std::numeric_limits<float>::min() * 0x1p24F;
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
                if (rays.t_min[lane] > 0.0F && state_[lane] == blocked && is_ray(lane))
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
    void settle(const RayStream& rays, std::size_t left, std::uint8_t* occluded) {
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
                          : t_at(k, ray) <= ray.t_max      ? 1
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
    LoneRay lone(const RayStream& rays, std::size_t i, std::size_t lane) const {
        const double unit = taken_.unit[lane];
        return {ray_of(paths_, lane),
                origin_surfaces_of(data_, paths_, lane),
                std::ilogb(unit),
                rays.t_min != nullptr ? std::max(0.0F, rays.t_min[i]) : 0.0F,
                rays.t_max != nullptr ? rays.t_max[i] : std::numeric_limits<float>::infinity(),
                rays.t_max != nullptr && rays.t_max[i] < std::numeric_limits<float>::max()
                    ? static_cast<double>(
                          std::nextafter(rays.t_max[i], std::numeric_limits<float>::infinity())) /
                          unit
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
    const Coherence* coherence_ = nullptr;
    std::uint32_t* doubtful_ = nullptr; // lanes
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

void StreamTracer::nearest(const RayStream& rays, const HitStream& hits) const {
    answer(rays.count, [&](Worker& worker, std::size_t first, std::size_t count) {
        worker.nearest(part_of(rays, first, count), part_of(hits, first));
    });
}

void StreamTracer::occluded(const RayStream& rays, std::uint8_t* occluded) const {
    answer(rays.count, [&](Worker& worker, std::size_t first, std::size_t count) {
        worker.occluded(part_of(rays, first, count), occluded + first);
    });
}

std::uint32_t StreamTracer::slot_of(core::ShapeId shape) const {
    std::call_once(has_slots_, [&] { slots_ = data_->slots_by_id(); });
    return shape < slots_.size() ? slots_[shape] : no_slot;
}

} // namespace raylane::simd
