#include "simd/query/certifier.hpp"

#include "core/numbers/infinity.hpp"

#include <algorithm>
#include <utility>

namespace raylane::simd {

namespace {

/// Returns a float that is not above a value >= 0, and not far below it.
float rounded_down(double value) {
    return static_cast<float>(value) * (1.0F - 0x1p-22F);
}

} // namespace

Certifier::Certifier(const SceneData& scene, const Tracing& tracing, Asked asked)
    : scene_(scene), tracing_(tracing), asked_(asked), resolver_(scene, tracing, asked) {
    if (!resolver_.works()) tie_breaker_.emplace(scene, tracing);
}

void Certifier::take_from(Arena& arena, std::size_t capacity) {
    doubtful_ = arena.take<std::uint8_t>(capacity);
    refined_ = arena.take<std::uint8_t>(capacity);
    at_contacts_ = arena.take<std::uint32_t>(capacity);
    gathered_.take_from(arena, capacity, false, asked_ == Asked::floats);
    gathered_hits_.take_from(arena, capacity, scene_.smooth());
    lanes_ = arena.take<std::uint32_t>(capacity);
    if (resolver_.works()) resolver_.take_from(arena);
}

void Certifier::find_own_exits(const Paths& paths, const CandidateSearch& search,
                               const Candidates& candidates) {
    std::fill_n(doubtful_, (paths.count + 15) / 16 * 16, std::uint8_t{0});
    std::fill_n(refined_, paths.count, std::uint8_t{0});
    std::uint32_t any = 0;
    for (std::size_t lane = 0; lane < paths.count; ++lane)
        any |= paths.origin_bits[lane];
    own_exit_count_ = 0;
    if ((any & origin_may_return) == 0) return;
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < paths.count; ++lane) {
        lanes_[count] = static_cast<std::uint32_t>(lane);
        count += static_cast<std::size_t>((paths.origin_bits[lane] & origin_may_return) != 0);
    }
    for (std::size_t i = 0; i < count; ++i) {
        gathered_.copy_ray(paths, lanes_[i], i);
        gathered_hits_.slot[i] = paths.origin_slot[lanes_[i]];
    }
    solve(gathered_hits_.found(gathered_, 0, count));
    own_exit_count_ = count;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t lane = lanes_[i], hit = gathered_hits_.hit[i];
        if ((hit & hit_doubtful) != 0) {
            doubtful_[lane] = 1;
        } else if ((hit & hit_none) == 0) {
            const double t = gathered_hits_.t[i] - search.approach().before(lane);
            candidates.first[lane] = tracing_.certifies()
                                         ? std::max(0.0F, rounded_down(t - gathered_hits_.error[i]))
                                         : static_cast<float>(t);
            candidates.slot[lane] = gathered_hits_.slot[i];
        }
    }
}

void Certifier::certify(const Paths& paths, CandidateSearch& search, const Candidates& candidates,
                        const Hits& hits, EngineCounters& counters) {
    contact_count_ = 0;
    if (!tracing_.certifies()) {
        break_ties(paths, candidates, hits);
        solve(hits.found(paths, 0, paths.count));
        return;
    }
    solve(hits.found(paths, 0, paths.count));
    const std::size_t uncertain = tracing_.kernels->rays.list_uncertain(
        paths.count, candidates, search.approach().from_there(hits.t), hits.error, hits.hit,
        doubtful_, resolver_.works() ? min_length : 0.0F, lanes_);
    if (!resolver_.works()) {
        compare_in_double(paths, {lanes_, uncertain}, hits, counters);
        return;
    }
    for (std::size_t k = 0; k < uncertain; ++k)
        refined_[lanes_[k]] = 1;
    contact_count_ =
        resolver_.refine(paths, search, doubtful_, {lanes_, uncertain}, hits, counters);
    std::copy_n(lanes_, contact_count_, at_contacts_);
}

void Certifier::find_of_few(const Paths& paths, const Candidates& candidates, const Hits& hits,
                            EngineCounters& counters) {
    contact_count_ = 0;
    TraceCounters traced{};
    tracing_.method().nearest_of_few(scene_.view(), scene_.listed_kinds(),
                                     hits.found(paths, 0, paths.count), candidates, traced);
    counters += traced;
    for (std::size_t i = 0; i < own_exit_count_; ++i)
        if (hits.slot[lanes_[i]] == gathered_hits_.slot[i]) hits.copy(gathered_hits_, i, lanes_[i]);
    for (const std::uint32_t lane : break_ties(paths, candidates, hits))
        solve_one(paths, lane, hits);
}

/// Solves the shape that was found for one lane.
void Certifier::solve_one(const Paths& paths, std::uint32_t lane, const Hits& hits) {
    gathered_.copy_ray(paths, lane, 0);
    gathered_hits_.slot[0] = hits.slot[lane];
    solve(gathered_hits_.found(gathered_, 0, 1));
    hits.copy(gathered_hits_, 0, lane);
}

void Certifier::solve(Found found) const {
    found.holds_points = asked_ == Asked::points;
    const MethodKernels& method = tracing_.method();
    (found.holds_points ? method.solve : method.solve_all)(scene_.view_with_copies(), found);
}

/// Breaks ties. The kernels keep one of several crossings at the same t, whichever they meet first,
/// and record that there is another. Ties are rare, so most packets take one check. Returns the
/// lanes whose shape has changed.
std::span<const std::uint32_t>
Certifier::break_ties(const Paths& paths, const Candidates& candidates, const Hits& hits) {
    std::size_t changed = 0;
    for (std::size_t begin = 0; begin < paths.count; begin += 16) {
        const float* const first = candidates.first + begin;
        const float* const second = candidates.second + begin;
        int ties = 0;
        for (int i = 0; i < 16; ++i)
            ties += static_cast<int>(first[i] == second[i]) &
                    static_cast<int>(first[i] < core::infinity<float>);
        if (ties == 0) continue;
        for (std::size_t i = 0; i < 16 && begin + i < paths.count; ++i) {
            if (first[i] != second[i] || first[i] == core::infinity<float>) continue;
            const std::size_t lane = begin + i;
            const std::uint32_t slot =
                tie_breaker_->first_at(first[i], paths, lane, hits.slot[lane]);
            if (std::exchange(hits.slot[lane], slot) != slot)
                lanes_[changed++] = static_cast<std::uint32_t>(lane);
        }
    }
    return {lanes_, changed};
}

/// Decides the shape of each lane. The numbers are those that the kernel computes for it.
void Certifier::compare_in_double(const Paths& paths, std::span<const std::uint32_t> lanes,
                                  const Hits& hits, EngineCounters& counters) {
    counters.doubtful += lanes.size();
    for (const std::uint32_t lane : lanes) {
        const TieBreaker::First first = tie_breaker_->first_of(paths, lane);
        if (!first.hit.any()) {
            hits.slot[lane] = no_slot;
            continue;
        }
        if (!first.is_alone) at_contacts_[contact_count_++] = lane;
        hits.slot[lane] = scene_.slot_of(first.hit.kind, first.hit.place);
        solve_one(paths, lane, hits);
    }
}

} // namespace raylane::simd
