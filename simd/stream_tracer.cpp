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

bool is_finite(const Vec3d& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// One ray of a stream, its direction brought near length 1 by a power of two: that is exact, and
/// lets no product in the solvers over- or underflow.
class LimitedRay {
  public:
    LimitedRay(const RayStream& rays, std::size_t i)
        : ray_{at(rays.origin, i), at(rays.direction, i)},
          t_min_(rays.t_min != nullptr ? std::max(0.0F, rays.t_min[i]) : 0.0F),
          t_max_(rays.t_max != nullptr ? rays.t_max[i] : infinity) {
        if (rays.t_min != nullptr && std::isnan(rays.t_min[i])) t_min_ = infinity;
        const Vec3d& d = ray_.direction;
        const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        is_ray_ = is_finite(ray_.origin) && is_finite(d) && largest > 0.0 && t_min_ < t_max_;
        if (!is_ray_) return;
        exponent_ = -std::ilogb(largest);
        ray_.direction *= scale();
        if (t_max_ < largest_t)
            t_most_ = static_cast<double>(std::nextafter(t_max_, infinity)) / scale();
    }

    bool is_ray() const { return is_ray_; }
    float t_min() const { return t_min_; }
    float t_max() const { return t_max_; }
    /// Exponent of the power of two that the direction was multiplied by.
    int exponent() const { return exponent_; }
    double scale() const { return std::ldexp(1.0, exponent_); }
    const core::Ray<double>& ray() const { return ray_; }
    /// No crossing counts from here on.
    double t_most() const { return t_most_; }

    /// A crossing's t for the caller.
    float t_of(const core::Scene& scene, const Hit<double>& hit) const {
        return core::rounded_t(scene, {ray_, {}}, hit, exponent_);
    }
    bool contains(float t) const { return t_min_ < t && t <= t_max_; }
    bool contains(const core::Scene& scene, const Hit<double>& hit) const {
        const bool is_limited = t_min_ > 0.0F || t_max_ < largest_t;
        return !is_limited || contains(t_of(scene, hit));
    }

  private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();
    static constexpr float largest_t = std::numeric_limits<float>::max();

    static Vec3d at(const float* const (&components)[3], std::size_t i) {
        return {static_cast<double>(components[0][i]), static_cast<double>(components[1][i]),
                static_cast<double>(components[2][i])};
    }

    core::Ray<double> ray_;
    float t_min_, t_max_;
    int exponent_ = 0; // the caller's t is ours times 2^exponent
    double t_most_ = std::numeric_limits<double>::infinity();
    bool is_ray_;
};

bool is_visible(const core::Scene& scene, const Hit<double>& hit) {
    return scene.material_of(hit.shape).is_seen(hit.entering);
}

void store(const HitStream& hits, std::size_t i, float t, const core::Vec3f& normal,
           core::ShapeId shape, bool entering) {
    if (hits.t != nullptr) hits.t[i] = t;
    for (int axis = 0; axis < 3; ++axis)
        if (hits.normal[axis] != nullptr) hits.normal[axis][i] = normal[axis];
    if (hits.shape != nullptr) hits.shape[i] = shape;
    if (hits.entering != nullptr) hits.entering[i] = entering ? 1 : 0;
}

void store_none(const HitStream& hits, std::size_t i) {
    store(hits, i, std::numeric_limits<float>::infinity(), core::Vec3f(0.0F), core::no_shape,
          false);
}

/// The nearest crossing between a ray's limits, or none.
Hit<double> nearest_of(const core::Scene& scene, Searcher& searcher, const LimitedRay& query) {
    if (!query.is_ray()) return {};
    return searcher.nearest_hit(
        query.ray(),
        [&](const Hit<double>& candidate) {
            return query.contains(scene, candidate) && is_visible(scene, candidate);
        },
        query.t_most());
}

bool wants_normals(const HitStream& hits) {
    return hits.normal[0] != nullptr || hits.normal[1] != nullptr || hits.normal[2] != nullptr;
}

/// Normal in float, where 0 has one sign.
core::Vec3f in_float(const Vec3d& normal) {
    return core::convert<float>(normal) + core::Vec3f(0.0F);
}

bool is_occluded(const core::Scene& scene, Searcher& searcher, const LimitedRay& query) {
    bool found = false;
    if (query.is_ray())
        searcher.each(query.ray(), {}, query.t_most(), [&](const Hit<double>& hit) {
            found = query.contains(scene, hit) && is_visible(scene, hit);
            return !found;
        });
    return found;
}

} // namespace

/// Answers up to some rays at a time, for one thread.
class StreamTracer::Worker {
  public:
    Worker(const core::Scene& scene, const SceneData& data, const Tracing& tracing,
           std::size_t capacity)
        : scene_(scene), data_(data), tracing_(tracing),
          searcher_(scene, core::Search::hierarchy, tracing.precision),
          query_(data, tracing, Asked::floats) {
        arena_ = arena_for([&](Arena& arena) { take_from(arena, capacity); });
    }

    void nearest(const RayStream& rays, std::size_t first, std::size_t last,
                 const HitStream& hits) {
        for (std::size_t i = first; i < last; ++i)
            store_none(hits, i);
        start(rays, first, last);
        EngineCounters counters;
        query_.nearest(paths_, nullptr, counters);
        if (!is_exact()) // else they meet several shapes there, and have the first
            for (const std::uint32_t lane : query_.at_contacts())
                at_contacts_[lane] = 1;
        const bool with_normals = wants_normals(hits);
        const Hits& found = query_.hits();
        for (std::size_t lane = 0; lane < paths_.count; ++lane) {
            const std::size_t i = first + paths_.sample[lane];
            const LimitedRay query(rays, i);
            const bool any = found.slot[lane] != no_slot;
            if (!any && at_contacts_[lane] == 0) continue;
            float t = 0.0F;
            if (at_contacts_[lane] != 0 || !is_seen(lane) ||
                (t = t_at(lane, query)) <= query.t_min()) {
                search(query, hits, i);
                continue;
            }
            if (!(t <= query.t_max())) continue;
            const bool entering = (found.hit[lane] & hit_entering) != 0;
            store(hits, i, t, with_normals ? normal_at(lane) : core::Vec3f(0.0F),
                  data_.id_of(found.slot[lane]), entering);
        }
    }

    void occluded(const RayStream& rays, std::size_t first, std::size_t last,
                  std::uint8_t* occluded) {
        for (std::size_t i = first; i < last; ++i)
            occluded[i] = 0;
        start(rays, first, last);
        for (std::size_t lane = 0; lane < paths_.count; ++lane) {
            const LimitedRay query(rays, first + paths_.sample[lane]);
            distance_[lane] = query.t_most() * paths_.length_of(lane);
            // A limit from below is no matter for bounds, nor is a t that is none until rounded.
            const bool simple = query.t_min() <= 0.0F &&
                                query.t_max() >= std::numeric_limits<float>::min() * 0x1p24F;
            state_[lane] = simple ? unblocked : doubtful;
        }
        EngineCounters counters;
        query_.occluded(paths_.columns(), distance_, state_, nullptr, counters);
        for (std::size_t lane = 0; lane < paths_.count; ++lane) {
            const std::size_t i = first + paths_.sample[lane];
            const LimitedRay query(rays, i);
            // What bounds call blocked says nothing of a limit from below; and what light may pass
            // blocks a ray here.
            occluded[i] = state_[lane] == blocked && query.t_min() <= 0.0F ? 1
                          : state_[lane] == unblocked
                              ? 0
                              : (is_occluded(scene_, searcher_, query) ? 1 : 0);
        }
    }

  private:
    bool is_exact() const { return tracing_.precision == core::Precision::exact; }

    /// The scalar search for one ray.
    void search(const LimitedRay& query, const HitStream& hits, std::size_t i) {
        const Hit<double> hit = nearest_of(scene_, searcher_, query);
        if (!hit.any()) {
            store_none(hits, i);
            return;
        }
        core::Vec3f normal(0.0F);
        if (wants_normals(hits))
            normal = is_exact() ? core::rounded_normal(scene_, {query.ray(), {}}, hit)
                                : in_float(searcher_.surface_at(query.ray(), {}, hit).normal);
        store(hits, i, query.t_of(scene_, hit), normal, hit.shape, hit.entering);
    }

    /// True if the lane's hit can be seen from where the ray comes.
    bool is_seen(std::size_t lane) const {
        if (!data_.one_sided()) return true;
        const Hits& found = query_.hits();
        const core::MaterialIndex material = data_.occupant_of(found.slot[lane]).material;
        return scene_.materials()[material].is_seen((found.hit[lane] & hit_entering) != 0);
    }

    /// t of the lane's hit, for the caller.
    float t_at(std::size_t lane, const LimitedRay& query) const {
        const Hits& found = query_.hits();
        const double per_unit = query.scale() / paths_.length_of(lane);
        const double t = found.t[lane] * per_unit;
        float rounded = 0.0F;
        // The length and both operations are off by a few ulps.
        const double error = found.error[lane] * per_unit * (1.0 + 0x1p-50) + 0x1p-50 * t;
        if (core::rounds_surely(t, is_exact() ? error : 0.0, rounded)) return rounded;
        return query.t_of(scene_, hit_of(data_, paths_, found, lane));
    }

    core::Vec3f normal_at(std::size_t lane) const {
        const Hits& found = query_.hits();
        if ((found.hit[lane] & (hit_normal_doubtful | hit_normal_unknown)) != 0)
            return core::rounded_normal(scene_, {ray_of(paths_, lane), {}},
                                        hit_of(data_, paths_, found, lane));
        return in_float({found.normal[0][lane], found.normal[1][lane], found.normal[2][lane]});
    }

    void take_from(Arena& arena, std::size_t capacity) {
        query_.take_from(arena, capacity);
        paths_.take_from(arena, capacity, false, /*for_others=*/true);
        at_contacts_ = arena.take<std::uint8_t>(capacity);
        distance_ = arena.take<double>(capacity);
        state_ = arena.take<std::uint8_t>(capacity);
    }

    /// The rays that are any, with unit directions.
    void start(const RayStream& rays, std::size_t first, std::size_t last) {
        paths_.count = 0;
        for (std::size_t i = first; i < last; ++i) {
            const LimitedRay query(rays, i);
            if (!query.is_ray()) continue;
            const std::size_t lane = paths_.count++;
            const double length = core::length(query.ray().direction);
            for (int axis = 0; axis < 3; ++axis) {
                paths_.origin[axis][lane] = query.ray().origin[axis];
                paths_.direction[axis][lane] = query.ray().direction[axis] / length;
                paths_.meant_direction[axis][lane] = query.ray().direction[axis];
            }
            paths_.meant_length[lane] = length;
            paths_.sample[lane] = static_cast<std::uint32_t>(i - first);
            at_contacts_[lane] = 0;
        }
        paths_.start_nowhere(0, paths_.count);
    }

    const core::Scene& scene_;
    const SceneData& data_;
    Tracing tracing_;
    Searcher searcher_;
    Query query_;
    Arena arena_;
    Paths paths_{}; // sample: the ray's number in the stream
    std::uint8_t* at_contacts_ = nullptr;
    double* distance_ = nullptr; // that an occluder must be within
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
        if (worker_ == nullptr)
            worker_ = std::make_unique<Worker>(tracer.scene_, *tracer.data_, tracer.tracing_,
                                               tracer.at_a_time());
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
      data_(std::make_unique<const SceneData>(scene)), tracing_{&kernels_of(isa), precision} {}

StreamTracer::~StreamTracer() = default;

std::size_t StreamTracer::at_a_time() const {
    return tracing_.precision == core::Precision::exact ? data_->best_ray_count() : fewest;
}

/// Calls answer(worker, first, last) for ranges of at most `most` that together are all rays.
template <class Answer>
void StreamTracer::answer(std::size_t count, std::size_t most, const Answer& answer) const {
    // All threads get some of what there is.
    const int threads = threads_ > 0 ? threads_ : default_threads();
    const std::size_t share = count / (std::size_t{4} * static_cast<std::size_t>(threads));
    const std::size_t range = std::clamp(share, fewest, most);
    const std::size_t ranges = (count + range - 1) / range;
    const auto answer_range = [&](Worker& worker, std::size_t number) {
        answer(worker, number * range, std::min(count, (number + 1) * range));
    };
    if (ranges <= 1 || threads == 1) {
        if (count == 0) return;
        const Lease worker(*this);
        for (std::size_t number = 0; number < ranges; ++number)
            answer_range(*worker, number);
        return;
    }
    on_threads(threads_, [&] {
        parallel_for(ranges, [&](std::size_t number) {
            const Lease worker(*this);
            answer_range(*worker, number);
        });
    });
}

void StreamTracer::nearest(const RayStream& rays, const HitStream& hits) const {
    answer(rays.count, at_a_time(), [&](Worker& worker, std::size_t first, std::size_t last) {
        worker.nearest(rays, first, last, hits);
    });
}

void StreamTracer::occluded(const RayStream& rays, std::uint8_t* occluded) const {
    answer(rays.count, fewest, [&](Worker& worker, std::size_t first, std::size_t last) {
        worker.occluded(rays, first, last, occluded);
    });
}

} // namespace raylane::simd
