#include "simd/wavefront/refinery.hpp"

#include "simd/wavefront/as_core.hpp"

#include <limits>

namespace raylane::simd {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Crossings are told apart where they are further from each other than this part of t: several
/// times the most that the reference, which would say that they coincide, may be off by.
constexpr double apart = 0x1p-24;

/// The limit of a ray of which not all candidates are listed.
constexpr float undecidable = -1.0F;

/// Not before what is behind a certain crossing by as little as does not tell them apart.
float limit_behind(double t) {
    return static_cast<float>(t) * candidate_grace;
}

} // namespace

void Refinery::take_from(Arena& arena) {
    paths_.take_from(arena, most, false);
    hits_.take_from(arena, most, scene_.smooth());
    lower_ = arena.take<float>(most);
    rays_ = arena.take<Ray>(most);
}

std::size_t Refinery::refine(const Paths& paths, const RoundedRays& rounded, const Pending& pending,
                             const std::uint8_t* doubtful, std::span<std::uint32_t> lanes,
                             const Hits& hits, core::Counters& counters) {
    std::size_t left = 0;
    for (std::size_t next = 0; next < lanes.size();) {
        count_ = ray_count_ = 0;
        for (; next < lanes.size() && ray_count_ < most; ++next) {
            const std::uint32_t lane = lanes[next];
            const bool is_hit = hits.slot[lane] != no_slot && hits.hit[lane] < hit_doubtful;
            const float limit = limit_behind(is_hit ? hits.t[lane] + hits.error[lane] : infinity);
            if (doubtful[lane] == 0 && add(paths, rounded, pending, lane, limit, counters))
                continue;
            // There may be room when the others are done.
            if (doubtful[lane] == 0 && count_ != 0) break;
            rays_[ray_count_++] = {lane, static_cast<std::uint32_t>(count_), undecidable};
        }
        finish();
        for (std::size_t i = 0; i < ray_count_; ++i) {
            const std::size_t end = i + 1 < ray_count_ ? rays_[i + 1].begin : count_;
            if (!decide(rays_[i], end, hits)) lanes[left++] = rays_[i].lane;
        }
    }
    counters.refined += lanes.size() - left;
    return left;
}

/// Whether there was room for a ray's candidates.
bool Refinery::add(const Paths& paths, const RoundedRays& rounded, const Pending& pending,
                   std::size_t lane, float limit, core::Counters& counters) {
    CandidateList list{hits_.slot + count_, lower_ + count_, most - count_, 0, limit};
    // No filter sees the shape that it starts on.
    if ((paths.departure[lane] & departure_may_return) != 0) {
        if (list.room == 0) return false;
        list.slot[0] = paths.departed_slot[lane];
        list.lower[list.count++] = 0.0F;
    }
    TraceCounters traced{};
    const bool has_room = tracing_.method().refine.list_candidates(
        scene_.view(), scene_.listed_kinds(), rounded, lane, pending, list, traced);
    count(traced, counters);
    if (!has_room) return false;

    const std::size_t begin = count_;
    for (std::size_t i = 0; i < list.count; ++i) {
        if (list.lower[i] > list.limit) continue; // which may have moved
        hits_.slot[count_] = list.slot[i];
        lower_[count_] = list.lower[i];
        paths_.copy_ray(paths, lane, count_++);
    }
    rays_[ray_count_++] = {static_cast<std::uint32_t>(lane), static_cast<std::uint32_t>(begin),
                           list.limit};
    return true;
}

void Refinery::finish() {
    tracing_.method().finish(scene_.view(), hits_.found(paths_, count_));
    tracing_.method().refine.finish_again(scene_.view(), hits_.found(paths_, count_));
}

bool Refinery::decide(const Ray& ray, std::size_t end, const Hits& hits) const {
    std::size_t first = end;
    for (std::size_t i = ray.begin; i < end; ++i)
        if (hits_.hit[i] < hit_doubtful && (first == end || hits_.t[i] < hits_.t[first])) first = i;

    // What is before this, if it is any, cannot be told from the first.
    const double last =
        first == end ? infinity : (hits_.t[first] + hits_.error[first]) * (1.0 + apart);
    for (std::size_t i = ray.begin; i < end; ++i) {
        const bool is_hit = hits_.hit[i] < hit_doubtful;
        if (i == first || hits_.hit[i] == hit_none) continue;
        const double from = is_hit ? hits_.t[i] - hits_.error[i] : static_cast<double>(lower_[i]);
        if (!(from > last)) return false;
    }
    if (!(last <= static_cast<double>(ray.limit))) return false;
    if (first == end)
        hits.slot[ray.lane] = no_slot;
    else
        hits.copy(hits_, first, ray.lane);
    return true;
}

const Hits& Refinery::finish(const Paths& paths, std::size_t lane, std::uint32_t slot) {
    paths_.copy_ray(paths, lane, 0);
    hits_.slot[0] = slot;
    count_ = 1;
    finish();
    return hits_;
}

} // namespace raylane::simd
