#include "simd/query/transparency_walk.hpp"

#include "core/shapes/shapes.hpp"
#include "simd/query/as_core.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::simd {

namespace {

/// Returns the lane's point among the known ones, or otherwise the point that the ray and its t
/// lead to.
core::Vec3d point_among(std::span<const HitPoint> points, const Hits& hits, const Paths& paths,
                        std::size_t lane) {
    for (const HitPoint& known : points)
        if (known.lane == lane) return known.point;
    const core::Ray<double> ray = ray_of(paths, lane);
    return core::mul_add(hits.t[lane], ray.direction, ray.origin);
}

} // namespace

TransparencyWalk::TransparencyWalk(const SceneData& scene, const Tracing& tracing)
    : scene_(scene), is_exact_(tracing.certifies()), query_(scene, tracing, Asked::points),
      solid_surfaces_(scene.scene()), cut_faces_(scene.scene()) {
    if (!scene.looks_through()) return;
    searcher_ = std::make_unique<core::Searcher<double>>(scene.scene(), core::Search::hierarchy,
                                                         tracing.precision);
    onward_ = std::make_unique<Query>(scene, tracing, Asked::points);
    const core::Solids& solids = scene.scene().solids();
    if (std::any_of(solids.nodes().begin(), solids.nodes().end(),
                    [](const core::Solids::Node& node) { return node.counts; }))
        skipper_ = std::make_unique<UnionSkipper>(scene, tracing);
}

void TransparencyWalk::take_from(Arena& arena, std::size_t capacity) {
    query_.take_from(arena, capacity);
    at_contacts_.reserve(capacity);
    points_.reserve(64);
    if (onward_ == nullptr) return;
    onward_->take_from(arena, capacity);
    if (skipper_ != nullptr) skipper_->take_from(arena, capacity);
    onward_paths_.take_from(arena, capacity, false);
    passed_ = arena.take<double>(capacity);
    ways_.resize(capacity);
}

void TransparencyWalk::nearest(const Paths& paths, const Coherence* coherence,
                               EngineCounters& counters) {
    query_.nearest(paths, coherence, counters);
    at_contacts_.assign(query_.at_contacts().begin(), query_.at_contacts().end());
    points_.assign(query_.points().begin(), query_.points().end());
    if (onward_ != nullptr) go_on(paths, coherence, counters);
    if (is_exact_) leave_near_surfaces(paths);
}

/// Leaves rays to the reference tracer that meet a surface next to the one that they leave. It
/// knows how to leave both.
void TransparencyWalk::leave_near_surfaces(const Paths& paths) {
    const Hits& hits = query_.hits();
    for (std::size_t lane = 0; lane < paths.count; ++lane) {
        if (paths.origin_slot[lane] == no_slot || hits.slot[lane] == no_slot) continue;
        if (!core::is_rounded_away(ray_of(paths, lane).origin, hits.t[lane])) continue;
        const auto number = static_cast<std::uint32_t>(lane);
        if (std::find(at_contacts_.begin(), at_contacts_.end(), number) == at_contacts_.end())
            at_contacts_.push_back(number);
    }
}

core::Vec3d TransparencyWalk::point_of(const Paths& paths, std::size_t lane) const {
    return point_among(points_, hits(), paths, lane);
}

void TransparencyWalk::go_on(const Paths& paths, const Coherence* coherence,
                             EngineCounters& counters) {
    const Hits& hits = query_.hits();
    for (const std::uint32_t lane : at_contacts_)
        hits.slot[lane] = no_slot; // the reference tracer follows these
    onward_paths_.count = 0;
    for (std::size_t lane = 0; lane < paths.count; ++lane) {
        core::WayInUnion way;
        if (is_visible(paths, hits, lane, way)) continue;
        if (!is_apart(query_, paths, lane)) {
            settle(paths, lane);
            continue;
        }
        const std::size_t to = onward_paths_.count++;
        ways_[to] = way;
        onward_paths_.copy(paths, lane, to);
        onward_paths_.sample[to] = static_cast<std::uint32_t>(lane);
        passed_[to] = 0.0;
        onward_paths_.move_to(to, point_of(paths, lane));
        move_on(hits, lane, to);
        std::erase_if(points_, [&](const HitPoint& point) { return point.lane == lane; });
    }
    // Rays that go on no longer start at one point.
    if (coherence != nullptr && !coherence->converging && !coherence->parallel)
        coherence = &neighbours;
    if (skipper_ != nullptr)
        skipper_->skip(onward_paths_, {ways_.data(), onward_paths_.count}, passed_);
    for (int passed = 1; onward_paths_.count != 0; ++passed) {
        if (passed == longest_walk) {
            at_contacts_.insert(at_contacts_.end(), onward_paths_.sample,
                                onward_paths_.sample + onward_paths_.count);
            return;
        }
        onward_->nearest(onward_paths_, coherence, counters);
        const Hits& found = onward_->hits();
        for (const std::uint32_t i : onward_->at_contacts()) {
            at_contacts_.push_back(onward_paths_.sample[i]);
            onward_paths_.sample[i] = no_slot;
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < onward_paths_.count; ++i) {
            const std::uint32_t lane = onward_paths_.sample[i];
            if (lane == no_slot) continue;
            const core::Vec3d point = point_among(onward_->points(), found, onward_paths_, i);
            if (is_visible(onward_paths_, found, i, ways_[i])) {
                hits.copy(found, i, lane);
                hits.t[lane] += passed_[i];
                // Behind several surfaces, the first origin and the sum of t do not lead to this
                // point.
                for (const HitPoint& known : onward_->points())
                    if (known.lane == i) points_.push_back({lane, known.point});
                continue;
            }
            if (!is_apart(*onward_, onward_paths_, i)) {
                settle(paths, lane);
                continue;
            }
            onward_paths_.copy(onward_paths_, i, kept);
            passed_[kept] = passed_[i];
            ways_[kept] = ways_[i];
            onward_paths_.move_to(kept, point);
            move_on(found, i, kept++);
        }
        onward_paths_.count = kept;
    }
}

/// Returns true if a ray crosses no other surface within the error of its hit point, before or
/// behind it. A ray that starts there then misses none. Decides where the bounds of the search do
/// not, so that images do not depend on its order.
bool TransparencyWalk::is_apart(const Query& query, const Paths& paths, std::size_t lane) {
    if (query.is_apart(paths, lane)) return true;
    const double t = query.hits().t[lane], error = query.error_of_point(paths, lane);
    int crossings = 0;
    const auto count = [&](const core::Hit<double>& hit) {
        if (!hit.at_start && std::abs(hit.t - t) <= error + hit.error) ++crossings;
        return false;
    };
    // Crossings of surfaces that the ray almost touches have larger errors.
    searcher_->nearest(ray_of(paths, lane), origin_surfaces_of(scene_, paths, lane), count,
                       t + 0x1p24 * error);
    return crossings <= 1;
}

/// Finds the first visible surface of a ray by the scalar search.
void TransparencyWalk::settle(const Paths& paths, std::size_t lane) {
    const core::Ray<double> ray = ray_of(paths, lane);
    const core::OriginSurfaces<double> origins = origin_surfaces_of(scene_, paths, lane);
    const core::Scene& scene = scene_.scene();
    const auto is_seen = [&](const core::Hit<double>& hit) {
        return scene.material_of(hit.shape).is_seen(hit.enters());
    };
    const core::Encounter<double> first = searcher_->nearest(ray, origins, is_seen);
    const Hits& hits = query_.hits();
    std::erase_if(points_, [&](const HitPoint& point) { return point.lane == lane; });
    if (first.contacts.size() > 1) {
        hits.slot[lane] = no_slot;
        at_contacts_.push_back(static_cast<std::uint32_t>(lane));
        return;
    }
    if (!first.hit.any()) {
        hits.slot[lane] = no_slot;
        return;
    }
    const core::Hit<double>& hit = first.hit;
    const auto surface = searcher_->surface_at(ray, origins, hit);
    core::Vec3d shading = core::with_table(scene.shapes(), hit.kind, [&](const auto& table) {
        return core::shading_normal_at(table.get(hit.place), surface.point, surface.normal);
    });
    if (core::dot(shading, surface.normal) < 0.0) shading = -shading;
    hits.slot[lane] = scene_.slot_of(hit.kind, hit.place);
    hits.t[lane] = hit.t;
    hits.error[lane] = hit.error;
    hits.hit[lane] = hit.face | (hit.entering ? hit_entering : 0U);
    hits.set_normals(lane, surface.normal, shading);
    points_.push_back({static_cast<std::uint32_t>(lane), surface.point});
}

/// Returns true if a ray that is inside of no part of a union of many certainly enters a part whose
/// whole inside belongs to the solid.
bool TransparencyWalk::fills_first(const Paths& paths, const Hits& hits, std::size_t lane,
                                   core::ShapeId shape) const {
    const core::Solids& solids = scene_.scene().solids();
    const core::Solids::Node& part = solids.node(solids.part_of(shape));
    if (!part.fills || part.kind != core::Kind::sphere || (hits.hit[lane] & hit_entering) == 0 ||
        part.parent == core::Solids::none || !solids.node(part.parent).counts)
        return false;
    const core::Solids::Index solid = solids.root_of(part.parent);
    if (solids.node(solid).open || solids.counted_of(solid) != part.parent) return false;
    double slope = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        slope += paths.direction[axis][lane] * hits.normal[axis][lane];
    constexpr double no_touch = -0x1p-20; // several times the error of the slope
    if (!(slope < no_touch)) return false;
    if (paths.origin_slot[lane] == no_slot)
        return !solids.bounds(part.parent).contains(ray_of(paths, lane).origin);
    const core::Solids::Index left = solids.part_of(scene_.id_of(paths.origin_slot[lane]));
    return left != core::Solids::none && solids.node(left).parent == part.parent &&
           (paths.origin_bits[lane] & origin_inward) == 0;
}

/// Returns true if a hit is visible. Otherwise `way` passes the hit. `way` is set at a ray's first
/// hit.
bool TransparencyWalk::is_visible(const Paths& paths, const Hits& hits, std::size_t lane,
                                  core::WayInUnion& way) {
    if (hits.slot[lane] == no_slot) return true;
    const core::Scene& scene = scene_.scene();
    const SceneData::ShapeRecord shape = scene_.record_of(hits.slot[lane]);
    const bool is_seen =
        scene.materials()[shape.material].is_seen(shape.is_entered(hits.hit[lane]));
    const core::Solids& solids = scene.solids();
    if (!solids.has(shape.id)) return is_seen;
    const bool is_first = &paths != &onward_paths_;
    const bool entering = (hits.hit[lane] & hit_entering) != 0;
    if (!is_first && way.hides(solids, shape.id, entering)) {
        way.pass(solids, shape.id, entering);
        return false;
    }
    if (is_seen && is_first && fills_first(paths, hits, lane, shape.id)) return true;
    const CutUnion* cut = scene_.cut_by(shape.id);
    if (is_seen && cut != nullptr) {
        const core::Value is_face = is_cut_face(paths, hits, lane, shape.id, *cut);
        if (is_face != core::Value::unknown) return is_face == core::Value::yes;
    }
    const core::Ray<double> ray = ray_of(paths, lane);
    const core::OriginSurfaces<double> origins = origin_surfaces_of(scene_, paths, lane);
    if (is_first) {
        way = {scene, {ray, origins}, shape.id};
        if (way.counted != core::Solids::none && scene_.is_cut(way.counted)) way = {};
    }
    if (is_seen &&
        solid_surfaces_.is_surface({ray, origins}, hit_of(scene_, paths, hits, lane), way)) {
        if (cut != nullptr) cut_faces_.remember(*cut, solid_surfaces_.last_around());
        return true;
    }
    way.pass(solids, shape.id, entering);
    return false;
}

/// Decides whether a part that cuts a union is visible at a hit, if that is easy to decide.
core::Value TransparencyWalk::is_cut_face(const Paths& paths, const Hits& hits, std::size_t lane,
                                          core::ShapeId shape, const CutUnion& cut) {
    const core::Ray<double> ray = ray_of(paths, lane);
    const double t = hits.t[lane];
    double size = t;
    for (int axis = 0; axis < 3; ++axis)
        size += std::abs(ray.origin[axis]);
    return cut_faces_.is_surface(cut, shape, ray.direction,
                                 core::mul_add(t, ray.direction, ray.origin),
                                 hits.error[lane] + 0x1p-48 * size);
}

/// Restarts a ray behind its hit. The ray has been moved to the hit point.
void TransparencyWalk::move_on(const Hits& hits, std::size_t lane, std::size_t to) {
    passed_[to] += hits.t[lane];
    const std::uint32_t slot = hits.slot[lane];
    onward_paths_.start_on(to, slot, scene_.record_of(slot), hits.hit[lane], /*through=*/true);
}

} // namespace raylane::simd
