#include "simd/query/candidate_resolver.hpp"

#include "core/numbers/infinity.hpp"
#include "core/reference/rounding.hpp"
#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"
#include "simd/query/as_core.hpp"

#include <algorithm>
#include <limits>

namespace raylane::simd {

namespace {

/// Elements behind the last candidate that kernels may write to.
constexpr std::size_t beyond = 32;

/// Number of candidates to list before the nearest of them are solved, to see whether more are
/// needed.
constexpr std::size_t at_first = 64;

/// The smallest limit of a list that includes bounds of 0.
constexpr float min_limit = std::numeric_limits<float>::min();

bool crosses(std::uint32_t hit) {
    return (hit & (hit_doubtful | hit_none)) == 0;
}

} // namespace

void CandidateResolver::take_from(Arena& arena) {
    paths_.take_from(arena, most + beyond, false, !for_points_);
    hits_.take_from(arena, most + beyond, scene_.smooth());
    lower_ = arena.take<double>(most);
    slots_.resize(most);
    bounds_.resize(most);
    listed_.reserve(most);
    rays_.reserve(most);
    close_.reserve(most);
    sharp_.reserve(64);
    wide_.reserve(std::size_t{3} * 64);
    points_.reserve(64);
}

std::size_t CandidateResolver::refine(const Paths& paths, const CandidateSearch& search,
                                      const std::uint8_t* doubtful, std::span<std::uint32_t> lanes,
                                      const Hits& hits, EngineCounters& counters) {
    counters.refined += lanes.size();
    points_.clear();
    std::size_t met_several = 0;
    const auto settle = [&](std::size_t where, std::size_t found, std::size_t begin) {
        const std::uint32_t lane = lanes[where];
        if (found == 0)
            hits.slot[lane] = no_slot;
        else
            hand_over(begin, hits, lane);
        if (found > 1) std::swap(lanes[where], lanes[met_several++]);
    };
    for (std::size_t next = 0; next < lanes.size();) {
        count_ = 0;
        rays_.clear();
        const std::size_t first = next;
        for (; next < lanes.size(); ++next) {
            const std::uint32_t lane = lanes[next];
            const bool is_hit =
                doubtful[lane] == 0 && hits.slot[lane] != no_slot && crosses(hits.hit[lane]);
            list(paths, search, lane,
                 is_hit ? hits.t[lane] + hits.error[lane] : core::infinity<double>, counters);
            if (is_hit) list_too(hits.slot[lane]);
            if (listed_.size() > most - count_) break;
            rays_.push_back({lane, static_cast<std::uint32_t>(count_)});
            add(paths, lane, listed_);
        }
        if (rays_.empty()) {
            settle(next, first_of_many(paths, lanes[next], counters), 0);
            ++next;
            continue;
        }
        solve(0);
        for (std::size_t i = 0; i < rays_.size(); ++i) {
            const std::size_t end = i + 1 < rays_.size() ? rays_[i + 1].begin : count_;
            settle(first + i, first_of(rays_[i].begin, end, counters), rays_[i].begin);
        }
    }
    return met_several;
}

/// Lists all shapes that a ray may cross before the limit, or before a certain crossing.
void CandidateResolver::list(const Paths& paths, const CandidateSearch& search, std::size_t lane,
                             double limit, EngineCounters& counters) {
    const double before = search.approach().before(lane);
    for (std::size_t room = at_first;; room *= 8) {
        // The limit is so far behind a certain crossing that crossings that cannot be distinguished
        // from it are listed, too. It also includes the error of the difference.
        const double beyond_there = before == 0.0 ? limit : limit * (1.0 + 0x1p-50) - before;
        const float limit_there =
            std::max(static_cast<float>(beyond_there) * candidate_tolerance, min_limit);
        if (room > slots_.size()) {
            slots_.resize(room);
            bounds_.resize(room);
        }
        CandidateList list = {slots_.data(), bounds_.data(), room, 0, limit_there, before == 0.0};
        // Filters do not see the shape on which the ray starts.
        if ((paths.origin_bits[lane] & origin_may_return) != 0) {
            list.slot[0] = paths.origin_slot[lane];
            list.lower[list.count++] = 0.0F;
        }
        TraceCounters traced{};
        const bool has_room = search.list(lane, list, traced);
        counters += traced;
        take(list, before);
        if (has_room) return;
        limit = std::min(limit, end_of_first(paths, lane, counters));
    }
}

/// Lists the shape that has been found, too: a part of a solid may be crossed outside of its
/// bounds, which enclose its visible surface only.
void CandidateResolver::list_too(std::uint32_t slot) {
    if (!scene_.scene().solids().any() ||
        std::any_of(listed_.begin(), listed_.end(),
                    [slot](const Listed& listed) { return listed.slot == slot; }))
        return;
    listed_.insert(listed_.begin(), {0.0, slot});
}

/// Takes candidates in the order of their bounds.
void CandidateResolver::take(const CandidateList& list, double before) {
    listed_.clear();
    for (std::size_t i = 0; i < list.count; ++i)
        if (list.lower[i] <= list.limit) // the limit may have decreased
            listed_.push_back(
                {(before + static_cast<double>(list.lower[i])) * (1.0 - 0x1p-50), list.slot[i]});
    std::sort(listed_.begin(), listed_.end(),
              [](const Listed& a, const Listed& b) { return a.lower < b.lower; });
}

/// Returns an upper bound of the first crossing's t, from the nearest listed candidates.
double CandidateResolver::end_of_first(const Paths& paths, std::size_t lane,
                                       EngineCounters& counters) {
    const std::size_t begin = count_;
    add(paths, lane, std::span(listed_).first(std::min({at_first, listed_.size(), most - begin})));
    solve(begin);
    const double end = end_of_first(begin, count_, counters);
    count_ = begin;
    return end;
}

void CandidateResolver::add(const Paths& paths, std::size_t lane,
                            std::span<const Listed> candidates) {
    for (const Listed& candidate : candidates) {
        hits_.slot[count_] = candidate.slot;
        lower_[count_] = candidate.lower;
        paths_.copy_ray(paths, lane, count_++);
    }
}

/// Solves candidates from `begin` on.
void CandidateResolver::solve(std::size_t begin) {
    Found found = hits_.found(paths_, begin, count_ - begin);
    found.holds_points = for_points_;
    tracing_.method().solve_all(scene_.view_with_copies(), found);
    tracing_.method().refine.refine(scene_.view_with_copies(), found);
}

/// Same as first_of() for all listed candidates, which exceed the capacity.
std::size_t CandidateResolver::first_of_many(const Paths& paths, std::size_t lane,
                                             EngineCounters& counters) {
    count_ = 0;
    for (std::size_t next = 0; next < listed_.size();) {
        const std::size_t found = count_;
        if (found != 0 && listed_[next].lower > hits_.t[0] + hits_.error[0]) break;
        const std::size_t count = std::min(most - count_, listed_.size() - next);
        add(paths, lane, std::span(listed_).subspan(next, count));
        solve(found);
        count_ = first_of(0, count_, counters);
        next += count;
    }
    return count_;
}

/// Returns an upper bound of the first crossing's t with candidates `begin` to `end`. Solves those
/// in doubt.
double CandidateResolver::end_of_first(std::size_t begin, std::size_t end,
                                       EngineCounters& counters) {
    double last = core::infinity<double>;
    for (std::size_t i = begin; i < end; ++i)
        if (crosses(hits_.hit[i])) last = std::min(last, hits_.t[i] + hits_.error[i]);
    for (std::size_t i = begin; i < end; ++i) {
        if ((hits_.hit[i] & hit_doubtful) == 0 || lower_[i] > last) continue;
        solve(i, counters);
        if (crosses(hits_.hit[i])) last = std::min(last, hits_.t[i] + hits_.error[i]);
    }
    return last;
}

/// Moves the candidate that its ray crosses first to `begin` and, behind it, another one that the
/// ray crosses at the same point. Returns the number of these: 0, 1 or 2.
std::size_t CandidateResolver::first_of(std::size_t begin, std::size_t end,
                                        EngineCounters& counters) {
    const double last = end_of_first(begin, end, counters);
    close_.clear();
    for (std::size_t i = begin; i < end; ++i)
        if (crosses(hits_.hit[i]) && hits_.t[i] - hits_.error[i] <= last * (1.0 + 0x1p-50))
            close_.push_back(i);
    if (close_.empty()) return 0;
    if (close_.size() > 1) return first_of_close(begin);
    swap(begin, close_[0]);
    return 1;
}

/// Computes the hits of the close candidates, with as many digits of t as cost little.
void CandidateResolver::extend_close() {
    const std::size_t count = close_.size();
    wide_.resize(3 * count);
    const WideCrossings wide = {wide_.data(), wide_.data() + count, wide_.data() + 2 * count};
    tracing_.method().refine.widen(scene_.view_with_copies(), hits_.found(paths_, 0, count_),
                                   close_.data(), count, wide);
    sharp_.clear();
    for (std::size_t k = 0; k < count; ++k)
        sharp_.emplace_back(hit_of(close_[k]), core::DoubleDouble(wide.high[k], wide.low[k]),
                            wide.error[k]);
}

/// Same as first_of() for the close candidates, in core's order.
std::size_t CandidateResolver::first_of_close(std::size_t begin) {
    const core::Ray<double> ray = ray_of(paths_, begin);
    const core::OriginSurfaces<double> origins = origin_surfaces_of(scene_, paths_, begin);
    const core::CrossingOrder order(scene_.scene(), {ray, origins});
    extend_close();
    std::size_t first = 0;
    for (std::size_t k = 1; k < sharp_.size(); ++k)
        if (order.is_before(sharp_[k], sharp_[first])) first = k;

    const core::Hit<double> sharp = sharp_[first].sharpened();
    const std::size_t chosen = close_[first];
    hits_.t[chosen] = sharp.t * paths_.length_of(chosen);
    hits_.error[chosen] = sharp.error * paths_.length_of(chosen) +
                          (paths_.stand_for_others() ? 0x1p-50 * hits_.t[chosen] : 0.0);
    const core::ShapeId shape = scene_.record_of(hits_.slot[chosen]).coplanar.first;
    std::size_t other = first;
    for (std::size_t k = 0; k < sharp_.size() && other == first; ++k)
        if (scene_.record_of(hits_.slot[close_[k]]).coplanar.first != shape &&
            order.compare(sharp_[k], sharp_[first]) == 0)
            other = k;
    const std::size_t with = close_[other];
    swap(begin, chosen);
    if (other == first) return 1;
    swap(begin + 1, with == begin ? chosen : with);
    return 2;
}

/// Solves a ray's first crossing with one shape, certified, without the normal.
void CandidateResolver::solve(std::size_t candidate, EngineCounters& counters) {
    ++counters.doubtful;
    const std::uint32_t slot = hits_.slot[candidate];
    const core::Kind kind = scene_.record_of(slot).kind;
    const core::Ray<double> ray = ray_of(paths_, candidate);
    const core::Start start =
        origin_surfaces_of(scene_, paths_, candidate).start_on(scene_.record_of(slot).id);
    hits_.hit[candidate] = hit_none;
    core::with_table(scene_.scene().shapes(), kind, [&](const auto& table) {
        for (const core::Crossing<double>& crossing :
             core::solve(table.get(scene_.place_of(slot)), ray, start, counters.widened)) {
            if (!(crossing.t > 0.0 || (start.on_surface && crossing.t == 0.0))) continue;
            if (!counts(candidate, crossing)) continue;
            const double length = paths_.length_of(candidate);
            hits_.t[candidate] = crossing.t * length;
            hits_.error[candidate] =
                crossing.error * length +
                (paths_.stand_for_others() ? 0x1p-50 * hits_.t[candidate] : 0.0);
            hits_.hit[candidate] =
                crossing.face | (crossing.entering ? hit_entering : 0) | hit_normal_unknown;
            return;
        }
    });
}

/// Returns true if a crossing with the candidate counts by the lower limit.
bool CandidateResolver::counts(std::size_t candidate,
                               const core::Crossing<double>& crossing) const {
    if (paths_.t_after == nullptr || !(paths_.t_after[candidate] > 0.0)) return true;
    const SceneData::ShapeRecord shape = scene_.record_of(hits_.slot[candidate]);
    const core::Hit<double> hit(crossing, shape.id, shape.kind,
                                scene_.place_of(hits_.slot[candidate]), shape.reversed);
    const core::Ray<double> ray = ray_of(paths_, candidate);
    const core::OriginSurfaces<double> origins = origin_surfaces_of(scene_, paths_, candidate);
    const double t_after = paths_.t_after[candidate];
    const std::uint32_t bits = paths_.origin_bits[candidate];
    const core::LeavingRay from{ray, origins};
    if ((bits & stream_half_ulp) != 0) {
        if (hit.t - 2.0 * hit.error > t_after * (1.0 + 0x1p-51)) return true;
        if (hit.t + 2.0 * hit.error < t_after) return false;
        return core::nearest_double_t(scene_.scene(), from, hit, 0) > t_after;
    }
    const int side = core::compare_t(scene_.scene(), from, hit, t_after);
    return side > 0 || (side == 0 && (bits & stream_tie_counts) != 0);
}

core::Hit<double> CandidateResolver::hit_of(std::size_t candidate) const {
    return simd::hit_of(scene_, paths_, hits_, candidate);
}

void CandidateResolver::swap(std::size_t a, std::size_t b) {
    if (a == b) return;
    hits_.swap(a, b);
    std::swap(lower_[a], lower_[b]);
}

void CandidateResolver::hand_over(std::size_t candidate, const Hits& hits, std::uint32_t lane) {
    if (for_points_ && (hits_.hit[candidate] & hit_normal_unknown) != 0) {
        const core::Ray<double> ray = ray_of(paths_, candidate);
        const core::OriginSurfaces<double> origins = origin_surfaces_of(scene_, paths_, candidate);
        const core::Hit<double> hit = hit_of(candidate);
        const auto [point, normal] = core::surface_point(scene_.scene(), {ray, origins}, hit);
        if (point != core::mul_add(hit.t, ray.direction, ray.origin))
            points_.push_back({lane, point});
        hits_.set_normals(candidate, normal,
                          core::with_table(scene_.scene().shapes(), hit.kind,
                                           [&, &at = point, &flat = normal](const auto& table) {
                                               return core::shading_normal_at(table.get(hit.place),
                                                                              at, flat);
                                           }));
    }
    // Points need no normals that round to floats.
    if (for_points_) hits_.hit[candidate] &= ~(hit_normal_unknown | hit_normal_doubtful);
    hits.copy(hits_, candidate, lane);
}

} // namespace raylane::simd
