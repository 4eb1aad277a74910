#include "simd/wavefront/hit_finder.hpp"

#include <algorithm>
#include <limits>

namespace raylane::simd {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A float that is not above a value >= 0, nor far below it.
float rounded_down(double value) {
    return static_cast<float>(value) * (1.0F - 0x1p-22F);
}

} // namespace

void take_rounded(Arena& arena, RoundedRays& rays, std::size_t capacity) {
    arena.take(rays.origin, capacity);
    arena.take(rays.direction, capacity);
    rays.slack = arena.take<float>(capacity);
}

Workspace workspace_for(const SceneData& scene, Arena& arena, std::size_t capacity) {
    Workspace workspace{};
    if (!scene.has_tree()) return workspace;
    const std::uint32_t levels = scene.view().tree_depth;
    const std::size_t entries = in_flight * pending_entries(levels);
    workspace.key = arena.take<std::uint16_t>(entries);
    workspace.child = arena.take<std::uint32_t>(entries);
    workspace.capacity = capacity;
    workspace.records = arena.take<std::byte>(capacity * stream_record_bytes);
    workspace.lists = arena.take<std::uint16_t>(list_entries(capacity, levels));
    return workspace;
}

HitFinder::HitFinder(const SceneData& scene, const Tracing& tracing,
                     core::ReferenceTracer<double>* reference, bool looks_through)
    : scene_(scene), tracing_(tracing), reference_(reference), refinery_(scene, tracing),
      for_points_(reference != nullptr), approach_(scene) {
    if (!tracing.certifies()) tie_breaker_.emplace(scene, tracing.precision);
    if (looks_through) onward_.reset(new HitFinder(scene, tracing, reference, false));
}

void HitFinder::take_from(Arena& arena, std::size_t capacity) {
    approach_.take_from(arena, capacity);
    take_rounded(arena, rounded_, capacity);
    candidates_.first = arena.take<float>(capacity);
    candidates_.second = arena.take<float>(capacity);
    workspace_ = workspace_for(scene_, arena, capacity);
    hits_.take_from(arena, capacity, scene_.smooth());
    doubtful_ = arena.take<std::uint8_t>(capacity);
    open_ = arena.take<std::uint32_t>(capacity);
    gathered_.take_from(arena, capacity, false, !for_points_);
    gathered_hits_.take_from(arena, capacity, scene_.smooth());
    lanes_ = arena.take<std::uint32_t>(capacity);
    if (refinery_.works()) refinery_.take_from(arena, !for_points_, for_points_);
    if (onward_ == nullptr) return;
    onward_->take_from(arena, capacity);
    onward_paths_.take_from(arena, capacity, false);
    passed_ = arena.take<double>(capacity);
}

void HitFinder::find(const Paths& paths, const Bundle* bundle, core::Counters& counters) {
    start(paths);
    find_own_exits(paths);
    if (approach_.any() && bundle != nullptr) bundle = &neighbours;

    TraceCounters traced{};
    tracing_.method().trace.nearest(scene_.view(), scene_.listed_kinds(), bundle, paths.count,
                                    rounded_, candidates_, workspace_, traced);
    count(traced, counters);

    if (tie_breaker_) break_ties(paths);
    finish(hits_.found(paths, 0, paths.count));
    lane_count_ = tracing_.certifies()
                      ? tracing_.kernels->rays.list_uncertain(
                            paths.count, candidates_, approach_.from_there(hits_.t), hits_.error,
                            hits_.hit, doubtful_, lanes_)
                      : 0;
    open_count_ = 0;
    points_.clear();
    if (!refinery_.works()) {
        ask_reference(paths, counters);
    } else {
        const std::size_t met_several =
            refinery_.refine(paths, {rounded_, approach_}, workspace_, doubtful_,
                             {lanes_, lane_count_}, hits_, counters);
        std::copy_n(lanes_, met_several, open_);
        open_count_ = met_several;
        points_.assign(refinery_.points().begin(), refinery_.points().end());
    }
    if (onward_ != nullptr) look_through(paths, bundle, counters);
}

void HitFinder::finish(Found found) const {
    found.holds_points = for_points_;
    (for_points_ ? tracing_.method().finish : tracing_.method().finish_all)(scene_.view(), found);
}

const Refinery::Point* HitFinder::known_point(std::size_t lane) const {
    for (const Refinery::Point& known : points_)
        if (known.lane == lane) return &known;
    return nullptr;
}

core::Vec3d HitFinder::point_of(const Paths& paths, std::size_t lane) const {
    if (const Refinery::Point* known = known_point(lane)) return known->point;
    const core::Ray<double> ray = ray_of(paths, lane);
    return core::mul_add(hits_.t[lane], ray.direction, ray.origin);
}

/// Rays pass a surface that cannot be seen from where they come as if it were not there.
void HitFinder::look_through(const Paths& paths, const Bundle* bundle, core::Counters& counters) {
    for (const std::uint32_t lane : left_open())
        hits_.slot[lane] = no_slot; // the reference goes on
    onward_paths_.count = 0;
    for (std::size_t lane = 0; lane < paths.count; ++lane) {
        if (is_visible(hits_, lane)) continue;
        const std::size_t to = onward_paths_.count++;
        onward_paths_.copy(paths, lane, to);
        onward_paths_.sample[to] = static_cast<std::uint32_t>(lane);
        passed_[to] = 0.0;
        onward_paths_.move_to(to, point_of(paths, lane));
        move_on(hits_, lane, to);
        std::erase_if(points_, [&](const Refinery::Point& of) { return of.lane == lane; });
    }
    // They no longer start at one point.
    if (bundle != nullptr && !bundle->towards && !bundle->parallel) bundle = &neighbours;
    for (int passed = 1; onward_paths_.count != 0; ++passed) {
        if (passed == longest_walk) {
            for (std::size_t i = 0; i < onward_paths_.count; ++i)
                open_[open_count_++] = onward_paths_.sample[i];
            return;
        }
        onward_->find(onward_paths_, bundle, counters);
        const Hits& found = onward_->hits();
        for (const std::uint32_t i : onward_->left_open()) {
            open_[open_count_++] = onward_paths_.sample[i];
            onward_paths_.sample[i] = no_slot;
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < onward_paths_.count; ++i) {
            const std::uint32_t lane = onward_paths_.sample[i];
            if (lane == no_slot) continue;
            if (is_visible(found, i)) {
                hits_.copy(found, i, lane);
                hits_.t[lane] += passed_[i];
                if (const Refinery::Point* known = onward_->known_point(i))
                    points_.push_back({lane, known->point});
                continue;
            }
            const core::Vec3d point = onward_->point_of(onward_paths_, i);
            onward_paths_.copy(onward_paths_, i, kept);
            passed_[kept] = passed_[i];
            onward_paths_.move_to(kept, point);
            move_on(found, i, kept++);
        }
        onward_paths_.count = kept;
    }
}

bool HitFinder::is_visible(const Hits& hits, std::size_t lane) const {
    if (hits.slot[lane] == no_slot) return true;
    const core::MaterialIndex material = scene_.occupant_of(hits.slot[lane]).material;
    return scene_.scene().materials()[material].is_seen((hits.hit[lane] & hit_entering) != 0);
}

/// Starts a ray anew behind what it has hit, where it has been moved to.
void HitFinder::move_on(const Hits& hits, std::size_t lane, std::size_t to) {
    passed_[to] += hits.t[lane];
    const std::uint32_t slot = hits.slot[lane];
    onward_paths_.start_on(to, slot, scene_.occupant_of(slot), hits.hit[lane], /*through=*/true);
}

void HitFinder::start(const Paths& paths) {
    paths.pass_to(rounded_);
    if (tracing_.precision == core::Precision::exact) approach_.bring_near(paths, rounded_);
    tracing_.kernels->rays.round_rays(paths.count, rounded_);
    approach_.widen(rounded_);
    candidates_.slot = hits_.slot;
    const std::size_t padded = (paths.count + 15) / 16 * 16;
    std::fill_n(candidates_.first, padded, infinity);
    std::fill_n(candidates_.second, padded, infinity);
    std::fill_n(hits_.slot, padded, no_slot);
    std::fill_n(doubtful_, padded, std::uint8_t{0});
}

/// Where a ray starts on a shape that it may cross again, no filter can tell 0 from that crossing.
/// It is solved before, and bounds what else can be nearest.
void HitFinder::find_own_exits(const Paths& paths) {
    std::uint32_t any = 0;
    for (std::size_t lane = 0; lane < paths.count; ++lane)
        any |= paths.departure[lane];
    if ((any & departure_may_return) == 0) return;
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < paths.count; ++lane) {
        lanes_[count] = static_cast<std::uint32_t>(lane);
        count += static_cast<std::size_t>((paths.departure[lane] & departure_may_return) != 0);
    }
    for (std::size_t i = 0; i < count; ++i) {
        gathered_.copy_ray(paths, lanes_[i], i);
        gathered_hits_.slot[i] = paths.departed_slot[lanes_[i]];
    }
    finish(gathered_hits_.found(gathered_, 0, count));
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t lane = lanes_[i], hit = gathered_hits_.hit[i];
        if ((hit & hit_doubtful) != 0) {
            doubtful_[lane] = 1;
        } else if ((hit & hit_none) == 0) {
            const double t = gathered_hits_.t[i];
            candidates_.first[lane] =
                tracing_.certifies() ? std::max(0.0F, rounded_down(t - gathered_hits_.error[i]))
                                     : static_cast<float>(t);
            candidates_.slot[lane] = gathered_hits_.slot[i];
        }
    }
}

/// The kernels take of several crossings at the same t whichever they meet first, and note that
/// there is another. That is rare: most packets are done with at a glance.
void HitFinder::break_ties(const Paths& paths) {
    for (std::size_t begin = 0; begin < paths.count; begin += 16) {
        const float* const first = candidates_.first + begin;
        const float* const second = candidates_.second + begin;
        int ties = 0;
        for (int i = 0; i < 16; ++i)
            ties += static_cast<int>(first[i] == second[i]) & static_cast<int>(first[i] < infinity);
        if (ties == 0) continue;
        for (std::size_t i = 0; i < 16 && begin + i < paths.count; ++i) {
            if (first[i] != second[i] || first[i] == infinity) continue;
            const std::size_t lane = begin + i;
            hits_.slot[lane] = tie_breaker_->first_at(first[i], paths, lane, hits_.slot[lane]);
        }
    }
}

/// Of doubles without bounds, the reference says which shape it is.
void HitFinder::ask_reference(const Paths& paths, core::Counters& counters) {
    counters.doubtful += lane_count_;
    if (reference_ == nullptr) {
        std::copy_n(lanes_, lane_count_, open_);
        open_count_ = lane_count_;
        return;
    }
    for (const std::uint32_t lane : std::span(lanes_, lane_count_)) {
        const core::Encounter<double> encounter =
            reference_->nearest(ray_of(paths, lane), departure_of(scene_, paths, lane));
        if (!encounter.hit.any())
            hits_.slot[lane] = no_slot;
        else if (encounter.contacts.size() > 1)
            open_[open_count_++] = static_cast<std::uint32_t>(lane);
        else
            settle(paths, lane, encounter.hit);
    }
}

/// The shape is decided. The numbers are those that the kernel has for it.
void HitFinder::settle(const Paths& paths, std::size_t lane, const core::Hit<double>& hit) {
    gathered_.copy_ray(paths, lane, 0);
    gathered_hits_.slot[0] = scene_.slot_of(hit.kind, hit.slot);
    finish(gathered_hits_.found(gathered_, 0, 1));
    hits_.copy(gathered_hits_, 0, lane);
}

} // namespace raylane::simd
