#include "simd/wavefront/shadow_tracer.hpp"

#include "core/optics/optics.hpp"
#include "simd/query/as_core.hpp"
#include "simd/wavefront/coherence.hpp"

#include <algorithm>
#include <cmath>

namespace raylane::simd {

namespace {

/// State in addition to Occlusion's: only a walk can decide.
constexpr std::uint8_t unasked = 3;

RayColumns columns_of(const SpawnedRays& rays, const std::uint32_t* origin_first,
                      const std::uint32_t* origin_last) {
    return {rays.count,
            {rays.origin[0], rays.origin[1], rays.origin[2]},
            {rays.direction[0], rays.direction[1], rays.direction[2]},
            origin_first,
            origin_last};
}

} // namespace

void take_spawned(Arena& arena, SpawnedRays& rays, std::size_t capacity) {
    arena.take(rays.origin, capacity);
    arena.take(rays.direction, capacity);
    arena.take(rays.weight, capacity);
    rays.distance = arena.take<double>(capacity);
    rays.parent = arena.take<double>(capacity);
}

ShadowTracer::ShadowTracer(const SceneData& scene, const Tracing& tracing,
                           core::ReferenceTracer<double>& reference, bool dims)
    : scene_(scene), reference_(reference), dims_(dims), walker_(scene, tracing) {}

void ShadowTracer::take_from(Arena& arena, std::size_t capacity, bool with_media) {
    leave_first_ = arena.take<std::uint32_t>(capacity);
    leave_last_ = arena.take<std::uint32_t>(capacity);
    leave_state_ = arena.take<std::uint8_t>(capacity);
    take_spawned(arena, rays_, capacity);
    origin_first_ = arena.take<std::uint32_t>(capacity);
    origin_last_ = arena.take<std::uint32_t>(capacity);
    state_ = arena.take<std::uint8_t>(capacity);
    walker_.take_from(arena, capacity);
    walk_.take_from(arena, capacity, with_media);
    walk_distance_ = arena.take<double>(capacity);
}

void ShadowTracer::trace(const LightView& light, EngineCounters& counters) {
    trace(coherence_of(light), counters);
}

void ShadowTracer::trace_softly(EngineCounters& counters) {
    trace(neighbours, counters);
}

void ShadowTracer::let_pass() {
    std::fill_n(state_, rays_.count, std::uint8_t{unblocked});
}

void ShadowTracer::trace(const Coherence& coherence, EngineCounters& counters) {
    counters.shadow += rays_.count;
    start();
    // Deeper waves hit surfaces far apart: too many shapes are between them and the light for a
    // search that takes many rays at a time.
    const bool together = wave_->coherent || !scene_.has_tree();
    find_blocked(together ? &coherence : nullptr, counters);

    walk_.count = 0;
    for (std::size_t k = 0; k < rays_.count; ++k)
        if (state_[k] == doubtful) start_walk(k);
    if (walk_.count != 0) walk(coherence, counters);
}

void ShadowTracer::look_at(const Wave& wave) {
    wave_.emplace(wave);
    for (std::size_t position = 0; position < wave.count; ++position) {
        const std::uint32_t lane = wave.order[position];
        const SceneData::ShapeRecord shape = scene_.record_of(wave.hits.slot[lane]);
        leave_first_[position] = shape.coplanar.first;
        leave_last_[position] = shape.coplanar.last;
        const bool inward = (wave.hits.hit[lane] & hit_entering) == 0;
        const bool in_medium = wave.paths.media_at(lane) != core::empty_space;
        const bool may_return =
            shape.may_be_met_again(inward) && !scene_.only_cuts(wave.hits.slot[lane]);
        leave_state_[position] = in_medium || may_return ? doubtful : unblocked;
        // Inside of an open solid's parts, none of these blocks rays by itself.
        if (!shape.is_entered(wave.hits.hit[lane]) && scene_.scene().solids().has(shape.id))
            leave_state_[position] = unasked;
    }
}

void ShadowTracer::start() {
    for (std::size_t k = 0; k < rays_.count; ++k) {
        const auto position = static_cast<std::size_t>(rays_.parent[k]);
        origin_first_[k] = leave_first_[position];
        origin_last_[k] = leave_last_[position];
        state_[k] = std::min<std::uint8_t>(leave_state_[position], blocked);
    }
}

void ShadowTracer::find_blocked(const Coherence* coherence, EngineCounters& counters) {
    walker_.query().occluded(columns_of(rays_, origin_first_, origin_last_), rays_.distance, state_,
                             coherence, counters);
    for (std::size_t k = 0; k < rays_.count; ++k)
        if (leave_state_[static_cast<std::size_t>(rays_.parent[k])] == unasked)
            state_[k] = doubtful;
}

void ShadowTracer::start_walk(std::size_t ray) {
    const Wave& wave = *wave_;
    const std::uint32_t lane = wave.order[static_cast<std::size_t>(rays_.parent[ray])];
    const std::uint32_t slot = wave.hits.slot[lane];
    const std::size_t to = walk_.count++;
    for (int axis = 0; axis < 3; ++axis) {
        walk_.origin[axis][to] = rays_.origin[axis][ray];
        walk_.direction[axis][to] = rays_.direction[axis][ray];
        walk_.throughput[axis][to] = rays_.weight[axis][ray];
    }
    walk_.sample[to] = static_cast<std::uint32_t>(ray);
    walk_.start_on(to, slot, scene_.record_of(slot), wave.hits.hit[lane], /*through=*/false);
    walk_.set_media(to, wave.paths.media_at(lane));
    walk_distance_[to] = rays_.distance[ray];
}

/// Walks from surface to surface, until the light or an opaque surface. Same as
/// core::ReferenceTracer::light_let_through.
void ShadowTracer::walk(const Coherence& coherence, EngineCounters& counters) {
    counters.walked += walk_.count;
    for (int passed = 0; walk_.count != 0; ++passed) {
        if (passed == longest_walk) {
            counters.followed += walk_.count;
            for (std::size_t lane = 0; lane < walk_.count; ++lane)
                follow(lane);
            return;
        }
        walker_.nearest(walk_, &coherence, counters);
        for (const std::uint32_t lane : walker_.at_contacts()) {
            ++counters.followed;
            follow(lane);
            walk_distance_[lane] = -1.0; // done
        }
        std::size_t kept = 0;
        for (std::size_t lane = 0; lane < walk_.count; ++lane) {
            double distance = walk_distance_[lane];
            if (distance < 0.0 || !step(lane, distance)) continue;
            if (lane != kept) walk_.copy(walk_, lane, kept);
            walk_distance_[kept++] = distance;
        }
        walk_.count = kept;
    }
}

/// Lets the reference tracer finish a walk.
void ShadowTracer::follow(std::size_t lane) {
    const core::Vec3d share =
        reference_.light_let_through(ray_of(walk_, lane), origin_surfaces_of(scene_, walk_, lane),
                                     walk_.media_at(lane), walk_distance_[lane]);
    if (share == core::Vec3d(0.0)) state_[walk_.sample[lane]] = blocked;
    for (int channel = 0; channel < 3; ++channel)
        rays_.weight[channel][walk_.sample[lane]] =
            walk_.throughput[channel][lane] * share[channel];
}

/// Takes a walk through the surface that it has found. Returns false if the walk is over.
bool ShadowTracer::step(std::size_t lane, double& distance) {
    const Hits& found = walker_.hits();
    const std::uint32_t number = walk_.sample[lane], slot = found.slot[lane];
    core::MediaStacks& stacks = reference_.media();
    const core::Media media = walk_.media_at(lane);
    if (slot == no_slot || !(found.t[lane] < distance)) {
        absorb(stacks.top(media), distance, lane);
        for (int channel = 0; channel < 3; ++channel)
            rays_.weight[channel][number] = walk_.throughput[channel][lane];
        return false;
    }
    const SceneData::ShapeRecord shape = scene_.record_of(slot);
    const core::Material& material = scene_.scene().materials()[shape.material];
    if (!material.lets_light_pass()) {
        state_[number] = blocked;
        return false;
    }
    const bool entering = shape.is_entered(found.hit[lane]);
    const core::MaterialIndex before = stacks.before(
        media, shape.medium, scene_.scene().materials()[shape.medium].transmits(), entering);
    const core::Media media_behind = scene_.scene().bounds_medium(shape.material, shape.medium)
                                         ? stacks.crossed(media, shape.medium, entering)
                                         : media;

    const double t = found.t[lane];
    double cos = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        cos += walk_.direction[axis][lane] * found.normal[axis][lane];
    const double share =
        !dims_ ? 1.0
               : core::let_straight_through(material, std::min(std::abs(cos), 1.0),
                                            scene_.medium(before).index,
                                            scene_.medium(stacks.top(media_behind)).index);
    absorb(before, t, lane);
    for (int channel = 0; channel < 3; ++channel)
        walk_.throughput[channel][lane] *= share;
    walk_.move_to(lane, walker_.point_of(walk_, lane));
    walk_.start_on(lane, slot, shape, found.hit[lane], /*through=*/true);
    walk_.set_media(lane, media_behind);
    distance -= t;
    return true;
}

void ShadowTracer::absorb(core::MaterialIndex medium, double distance, std::size_t lane) {
    if (!dims_ || medium == core::no_medium) return;
    const core::Vec3d share =
        core::let_through_medium(scene_.scene().materials()[medium], distance);
    for (int channel = 0; channel < 3; ++channel)
        walk_.throughput[channel][lane] *= share[channel];
}

} // namespace raylane::simd
