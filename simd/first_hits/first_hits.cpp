#include "simd/first_hits/first_hits.hpp"

#include "core/shapes/shapes.hpp"
#include "simd/query/as_core.hpp"
#include "simd/wavefront/camera_view.hpp"
#include "simd/wavefront/coherence.hpp"

#include <algorithm>

namespace raylane::simd {

namespace {

/// Sets the normals, turned to where the ray comes from. An apex has no normal, and its substitute
/// may point to the wrong side; then the ray's reverse direction replaces it.
void set_normals(FirstHit& hit, core::Vec3d flat, core::Vec3d shading, bool entering) {
    if (!entering) {
        flat = -flat;
        shading = -shading;
    }
    if (core::dot(flat, hit.ray.direction) > 0x1p-20) shading = flat = -hit.ray.direction;
    hit.flat_normal = flat;
    hit.shading_normal = shading;
}

} // namespace

FirstHits::FirstHits(const SceneData& scene, const core::Settings& settings, const Kernels& kernels)
    : scene_(scene), tracing_{&kernels, core::Precision::exact},
      camera_rays_(scene.scene().camera(), settings), camera_(view_of(camera_rays_)),
      coherence_(coherence_of(camera_)), finder_(scene, tracing_),
      searcher_(scene.scene(), core::Search::hierarchy, core::Precision::exact),
      width_(settings.width), height_(settings.height) {
    arena_ = arena_for([this](Arena& arena) { take_from(arena); });
    places_.reserve(chunk);
}

void FirstHits::take_from(Arena& arena) {
    paths_.take_from(arena, chunk, false);
    finder_.take_from(arena, chunk);
    across_ = arena.take<double>(chunk);
    upward_ = arena.take<double>(chunk);
}

void FirstHits::trace(const core::Region& points, int per_pixel, std::vector<FirstHit>& hits) {
    const int columns = points.x1 - points.x0;
    hits.resize(static_cast<std::size_t>(points.pixels()));
    for (int top = points.y0; top < points.y1; top += square)
        for (int left = points.x0; left < points.x1; left += square)
            for (int y = top; y < std::min(top + square, points.y1); ++y)
                for (int x = left; x < std::min(left + square, points.x1); ++x) {
                    across_[places_.size()] = (2.0 * x + 1.0) / per_pixel - width_;
                    upward_[places_.size()] = height_ - (2.0 * y + 1.0) / per_pixel;
                    places_.push_back(static_cast<std::size_t>(y - points.y0) *
                                          static_cast<unsigned>(columns) +
                                      static_cast<unsigned>(x - points.x0));
                    if (places_.size() == chunk) flush(hits);
                }
    flush(hits);
}

void FirstHits::flush(std::vector<FirstHit>& hits) {
    const std::size_t count = places_.size();
    if (count == 0) return;
    paths_.count = count;
    tracing_.kernels->rays.camera_rays(camera_, count, across_, upward_, nullptr, nullptr,
                                       paths_.origin, paths_.direction);
    paths_.start_nowhere(0, count);
    finder_.nearest(paths_, &coherence_, counters_);
    for (std::size_t lane = 0; lane < count; ++lane)
        hits[places_[lane]] = hit_at(lane);
    for (const std::uint32_t lane : finder_.at_contacts())
        settle(lane, hits[places_[lane]]);
    places_.clear();
}

FirstHit FirstHits::hit_at(std::size_t lane) const {
    const Hits& found = finder_.hits();
    FirstHit hit{ray_of(paths_, lane)};
    if (found.slot[lane] == no_slot) return hit;
    const SceneData::ShapeRecord shape = scene_.record_of(found.slot[lane]);
    hit.t = found.t[lane];
    hit.shape = shape.id;
    hit.material = shape.material;
    hit.face = static_cast<core::Face>(found.hit[lane] & hit_face);
    core::Vec3d flat, shading;
    for (int axis = 0; axis < 3; ++axis) {
        const double* smooth = found.shading_normal[axis];
        flat[axis] = found.normal[axis][lane];
        shading[axis] = smooth != nullptr ? smooth[lane] : flat[axis];
    }
    set_normals(hit, flat, shading, (found.hit[lane] & hit_entering) != 0);
    return hit;
}

/// Finds a ray's first visible surface by the scalar search, where several surfaces meet.
void FirstHits::settle(std::size_t lane, FirstHit& hit) {
    const core::Scene& scene = scene_.scene();
    hit = FirstHit{ray_of(paths_, lane)};
    const core::Hit<double> first =
        searcher_
            .nearest(hit.ray, {},
                     [&](const core::Hit<double>& candidate) {
                         return scene.material_of(candidate.shape).is_seen(candidate.enters());
                     })
            .hit;
    if (!first.any()) return;
    const auto [point, flat] = searcher_.surface_at(hit.ray, {}, first);
    core::Vec3d shading = core::with_table(
        scene.shapes(), first.kind, [&, &at = point, &there = flat](const auto& table) {
            return core::shading_normal_at(table.get(first.place), at, there);
        });
    if (core::dot(shading, flat) < 0.0) shading = -shading;
    hit.t = first.t;
    hit.shape = first.shape;
    hit.material = scene.material_index_of(first.shape);
    hit.face = first.face;
    set_normals(hit, flat, shading, first.entering);
}

void fill_aovs(FirstHits& tracer, const core::Region& region, const core::Region& frame,
               core::Aovs& aovs) {
    std::vector<FirstHit> hits;
    tracer.trace(region, 1, hits);
    auto hit = hits.begin();
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x, ++hit) {
            const std::size_t pixel = aovs.index(x - frame.x0, y - frame.y0);
            aovs.depth[pixel] = static_cast<float>(hit->t);
            aovs.normal[pixel] = core::convert<float>(hit->shading_normal);
            aovs.shape[pixel] = hit->shape;
            aovs.material[pixel] = hit->material;
        }
}

} // namespace raylane::simd
