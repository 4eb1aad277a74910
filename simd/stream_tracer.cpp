#include "simd/stream_tracer.hpp"

#include "core/reference/search.hpp"
#include "simd/threads.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace raylane::simd {

namespace {

using core::Hit;
using core::Vec3d;
using Searcher = core::Searcher<double>;

/// Rays to a task. Fewer are not worth a second thread.
constexpr std::size_t chunk_size = 512;

/// Calls visit(first, last) for ranges that together are all rays.
void for_each_chunk(std::size_t count, int threads,
                    const std::function<void(std::size_t, std::size_t)>& visit) {
    if (count <= chunk_size || threads == 1) {
        if (count > 0) visit(0, count);
        return;
    }
    on_threads(threads, [&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, chunk_size),
                          [&](const auto& range) { visit(range.begin(), range.end()); });
    });
}

bool is_finite(const Vec3d& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// One ray of a stream, its direction brought near length 1 by a power of two: that is exact, and
/// lets no product in the solvers over- or underflow.
class Query {
  public:
    Query(const RayStream& rays, std::size_t i)
        : ray_{at(rays.origin, i), at(rays.direction, i)},
          t_min_(rays.t_min != nullptr ? std::max(0.0F, rays.t_min[i]) : 0.0F),
          t_max_(rays.t_max != nullptr ? rays.t_max[i] : infinity) {
        if (rays.t_min != nullptr && std::isnan(rays.t_min[i])) t_min_ = infinity;
        const Vec3d& d = ray_.direction;
        const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        is_ray_ = is_finite(ray_.origin) && is_finite(d) && largest > 0.0 && t_min_ < t_max_;
        if (!is_ray_) return;
        scale_ = std::ldexp(1.0, -std::ilogb(largest));
        ray_.direction *= scale_;
        if (t_max_ < largest_t)
            t_most_ = static_cast<double>(std::nextafter(t_max_, infinity)) / scale_;
    }

    bool is_ray() const { return is_ray_; }
    const core::Ray<double>& ray() const { return ray_; }
    /// No crossing counts from here on.
    double t_most() const { return t_most_; }

    /// A crossing's t for the caller.
    float t_of(const Hit<double>& hit) const {
        constexpr auto least = static_cast<double>(std::numeric_limits<float>::denorm_min());
        return static_cast<float>(
            std::clamp(hit.t * scale_, least, static_cast<double>(largest_t)));
    }
    bool contains(const Hit<double>& hit) const {
        const float t = t_of(hit);
        return t_min_ < t && t <= t_max_;
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
    double scale_ = 1.0; // of the direction; the caller's t is this times ours
    double t_most_ = std::numeric_limits<double>::infinity();
    bool is_ray_;
};

bool is_visible(const core::Scene& scene, const Hit<double>& hit) {
    const core::Visible visible = scene.material_of(hit.shape).visible;
    return visible == core::Visible::both || (visible == core::Visible::outside) == hit.entering;
}

void store(const HitStream& hits, std::size_t i, float t, const Vec3d& normal,
           core::ShapeId shape) {
    if (hits.t != nullptr) hits.t[i] = t;
    for (int axis = 0; axis < 3; ++axis)
        if (hits.normal[axis] != nullptr) hits.normal[axis][i] = static_cast<float>(normal[axis]);
    if (hits.shape != nullptr) hits.shape[i] = shape;
}

void find_nearest(const core::Scene& scene, Searcher& searcher, const Query& query,
                  const HitStream& hits, std::size_t i) {
    Hit<double> hit;
    if (query.is_ray())
        hit = searcher
                  .nearest(
                      query.ray(), {},
                      [&](const Hit<double>& candidate) {
                          return query.contains(candidate) && is_visible(scene, candidate);
                      },
                      query.t_most())
                  .hit;
    if (!hit.any()) {
        store(hits, i, std::numeric_limits<float>::infinity(), Vec3d(0.0), core::no_shape);
        return;
    }
    const Vec3d point = core::mul_add(hit.t, query.ray().direction, query.ray().origin);
    store(hits, i, query.t_of(hit), searcher.outward_normal_at(hit, point), hit.shape);
}

bool is_occluded(const core::Scene& scene, Searcher& searcher, const Query& query) {
    bool found = false;
    if (query.is_ray())
        searcher.each(query.ray(), {}, query.t_most(), [&](const Hit<double>& hit) {
            found = query.contains(hit) && is_visible(scene, hit);
            return !found;
        });
    return found;
}

} // namespace

void StreamTracer::nearest(const RayStream& rays, const HitStream& hits) const {
    for_each_chunk(rays.count, threads_, [&](std::size_t first, std::size_t last) {
        Searcher searcher(scene_, core::Search::hierarchy);
        for (std::size_t i = first; i < last; ++i)
            find_nearest(scene_, searcher, Query(rays, i), hits, i);
    });
}

void StreamTracer::occluded(const RayStream& rays, std::uint8_t* occluded) const {
    for_each_chunk(rays.count, threads_, [&](std::size_t first, std::size_t last) {
        Searcher searcher(scene_, core::Search::hierarchy);
        for (std::size_t i = first; i < last; ++i)
            occluded[i] = is_occluded(scene_, searcher, Query(rays, i)) ? 1 : 0;
    });
}

} // namespace raylane::simd
