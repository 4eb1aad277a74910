#include "simd/query/copy_search.hpp"

#include "core/numbers/infinity.hpp"
#include "simd/query/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace raylane::simd {

namespace {

/// Number of copies whose transformations are cached; a power of two.
constexpr std::size_t places = 1024;

constexpr auto largest_float = double(std::numeric_limits<float>::max());

float up(double value) {
    return value < largest_float ? rounded_up(static_cast<float>(value)) : core::infinity<float>;
}
float down(double value) {
    if (!(value > 0.0)) return 0.0F;
    return static_cast<float>(std::min(value, largest_float)) * (1.0F - 0x1p-21F);
}

double sum_of(const core::Vec3d& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Returns true if a ray of length 1 certainly misses a box that is wider by `slack`. Rays through
/// an edge, and NaN, miss nothing.
bool misses(const core::Bounds& box, const core::Vec3d& origin, const core::Vec3d& direction,
            double slack) {
    double near = 0.0, far = core::infinity<double>;
    for (int axis = 0; axis < 3; ++axis) {
        const double inverse = 1.0 / direction[axis];
        const double a = (static_cast<double>(box.lower[axis]) - slack - origin[axis]) * inverse;
        const double b = (static_cast<double>(box.upper[axis]) + slack - origin[axis]) * inverse;
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return near > far * (1.0 + 0x1p-40);
}

double before_of(const RoundedRays& rays, std::size_t i) {
    return rays.before != nullptr ? rays.before[i] : 0.0;
}

core::Vec3d vector_at(const double* const (&columns)[3], std::size_t i) {
    return {columns[0][i], columns[1][i], columns[2][i]};
}

} // namespace

CopySearch::CopySearch(const SceneData& scene, const Tracing& tracing)
    : scene_(scene), tracing_(tracing), placed_(places),
      travellers_(wave, Traveller{core::CopyWalk(*scene.scene().copies())}),
      lanes_(std::make_unique<Columns>()) {
    for (int axis = 0; axis < 3; ++axis) {
        rounded_.origin[axis] = lanes_->origin[axis];
        rounded_.direction[axis] = lanes_->direction[axis];
        rounded_.exact_origin[axis] = lanes_->exact_origin[axis];
        rounded_.exact_direction[axis] = lanes_->exact_direction[axis];
    }
    rounded_.slack = lanes_->slack;
    rounded_.origin_first = lanes_->origin_first;
    rounded_.origin_last = lanes_->origin_last;
}

void CopySearch::take_from(Arena& arena) {
    const SceneData* deepest = nullptr;
    for (const auto& prototype : scene_.prototypes())
        if (deepest == nullptr || prototype->view().tree_depth > deepest->view().tree_depth)
            deepest = prototype.get();
    workspace_ = workspace_for(*deepest, arena, wave);
}

const CopySearch::Placed& CopySearch::placed_at(std::uint32_t copy) {
    Placed& placed = placed_[copy % places];
    if (placed.copy == copy) return placed;
    const core::Copies& copies = *scene_.scene().copies();
    const core::Copies::Copy row = copies.copy_at(copy);
    const core::Placement& placement = copies.placement(copy);
    placed.copy = copy;
    placed.set = static_cast<std::uint32_t>(&row.set - copies.sets().data());
    placed.first_id = core::Copies::first_id_of(row);
    placed.rows = core::rows_of(placement);
    placed.translate = placement.translate;
    placed.scale = placement.scale;
    return placed;
}

void CopySearch::start(core::CopyWalk& walk, const RoundedRays& rays, std::size_t i) {
    const core::Vec3d origin = vector_at(rays.exact_origin, i);
    const core::Vec3d direction = vector_at(rays.exact_direction, i);
    const double before = before_of(rays, i);
    // The start is moved along the ray, with a rounding of each product and sum, and of the
    // direction.
    const double size = std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z) + before;
    walk.start({before == 0.0 ? origin : core::Vec3d(origin + before * direction), direction},
               before == 0.0 ? 0.0 : 0x1p-49 * size);
}

template <class Limit, class Visit>
void CopySearch::for_each_copy(const RoundedRays& rays, std::size_t i, const Limit& t_limit,
                               const Visit& visit) {
    core::CopyWalk& walk = travellers_.front().walk;
    start(walk, rays, i);
    std::uint32_t copy = 0;
    while (walk.next(t_limit(), copy)) {
        const Local local = place(rays, i, copy, 0);
        if (!local.is_beside && !visit(local)) return;
    }
}

template <class Limit, class Search, class Done>
void CopySearch::in_waves(std::size_t count, const RoundedRays& rays, const Limit& t_limit,
                          const Search& search, const Done& done) {
    Traveller* way[wave];
    for (std::size_t k = 0; k < wave; ++k)
        way[k] = &travellers_[k];
    std::size_t next = 0, on_their_way = 0;
    do {
        for (; on_their_way < wave && next < count; ++next) {
            if (!(t_limit(next) >= 0.0)) continue;
            Traveller& traveller = *way[on_their_way++];
            traveller.ray = next;
            traveller.found_slot = no_slot;
            start(traveller.walk, rays, next);
        }
        // Walks alternate, as each step waits for memory that the previous one asked for.
        for (std::size_t arrived = 0; arrived < on_their_way;)
            for (std::size_t k = arrived; k < on_their_way;) {
                Traveller& traveller = *way[k];
                switch (traveller.walk.step(t_limit(traveller.ray), traveller.local.copy)) {
                case core::CopyWalk::At::node:
                    ++k;
                    break;
                case core::CopyWalk::At::copy:
                    std::swap(way[arrived++], way[k++]);
                    break;
                case core::CopyWalk::At::end:
                    done(traveller);
                    std::swap(way[k], way[--on_their_way]);
                    break;
                }
            }
        search_prototypes({way, on_their_way}, rays, search);
    } while (on_their_way != 0 || next < count);
}

template <class Search>
void CopySearch::search_prototypes(std::span<Traveller*> travellers, const RoundedRays& rays,
                                   const Search& search) {
    if (scene_.prototypes().size() > 1)
        std::sort(travellers.begin(), travellers.end(), [](const auto* a, const auto* b) {
            return a->local.copy < b->local.copy; // copies of a set have consecutive numbers
        });
    Traveller* in_lanes[wave];
    std::size_t lanes = 0;
    const auto search_lanes = [&] {
        if (lanes != 0)
            search(prototype_of(in_lanes[0]->local), std::span<Traveller* const>(in_lanes, lanes));
        lanes = 0;
    };
    for (Traveller* const each : travellers) {
        if (lanes != 0 && placed_at(each->local.copy).set != in_lanes[0]->local.set) search_lanes();
        each->local = place(rays, each->ray, each->local.copy, lanes);
        if (!each->local.is_beside) in_lanes[lanes++] = each;
    }
    search_lanes();
}

/// Claim: the exact ray in the space of the prototype, and the prototype's shapes, differ from the
/// images of ray and copy by less than the slack, and t by less than `error`.
///
/// Let m be the sum of the sizes of all numbers. The place of the ray's start takes some 20
/// operations in double, each with an error of at most half an ulp of m: together 20 * 2^-53 m. The
/// rows of the map have errors of a few ulps, and are perpendicular within a few; so are its
/// inverse's. The direction has an error of 2^-50, along at most 4 radii. The numbers of the copy's
/// shapes are rounded to doubles of at most m, which moves their surfaces by less than 16 half ulps
/// of m. The sum is less than 2^-47 m.
CopySearch::Local CopySearch::place(const RoundedRays& rays, std::size_t i, std::uint32_t copy,
                                    std::size_t lane) {
    const Placed& placed = placed_at(copy);
    const core::Copies::Set& set = scene_.scene().copies()->sets()[placed.set];
    const core::Vec3d exact_origin = vector_at(rays.exact_origin, i);
    const core::Vec3d exact_direction = vector_at(rays.exact_direction, i);
    const core::Vec3d from = exact_origin - placed.translate;
    const double before = before_of(rays, i);
    const double shrink = 1.0 / placed.scale;
    core::Vec3d origin(0.0), direction(0.0);
    for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis] += placed.rows[k][axis] * from[k];
            direction[axis] += placed.rows[k][axis] * exact_direction[k];
        }
    origin = (shrink * shrink) * origin;
    direction = shrink * direction;
    // Like Approach, for the sphere around the copy.
    const double closest = core::dot(set.center - origin, direction);
    const double start = std::max(before * shrink, closest - 2.0 * set.radius);
    origin = core::mul_add(start, direction, origin);

    const double size = sum_of(exact_origin) + sum_of(placed.translate) +
                        placed.scale * (sum_of(set.center) + 4.0 * set.radius + start);
    Local local{copy, placed.set, placed.scale * start, placed.scale, 0x1p-45 * size, false};
    double moved = local.error * shrink;
    for (int axis = 0; axis < 3; ++axis) {
        const auto nearest = static_cast<float>(origin[axis]);
        moved += std::abs(origin[axis] - static_cast<double>(nearest));
        lanes_->origin[axis][lane] = nearest;
        lanes_->direction[axis][lane] = static_cast<float>(direction[axis]);
        lanes_->exact_origin[axis][lane] = origin[axis];
        lanes_->exact_direction[axis][lane] = direction[axis];
    }
    lanes_->slack[lane] = static_cast<float>(moved * (1.0 + 0x1p-12)) +
                          least_slack(prototype_of(local).view().rounding);
    local.is_beside = misses(set.prototype->hierarchy().bounds, origin, direction,
                             2.0 * static_cast<double>(lanes_->slack[lane]));
    const bool is_inside =
        rays.origin_first[i] != no_slot && rays.origin_first[i] - placed.first_id < set.shape_count;
    lanes_->origin_first[lane] = is_inside ? rays.origin_first[i] - placed.first_id : no_slot;
    lanes_->origin_last[lane] = is_inside ? rays.origin_last[i] - placed.first_id : no_slot;
    return local;
}

std::uint32_t CopySearch::slot_of(std::uint32_t copy, std::uint32_t slot) const {
    return scene_.slot_in_copy(scene_.scene().copies()->copy_at(copy), slot);
}

void CopySearch::nearest(std::size_t count, const RoundedRays& rays, const Candidates& candidates,
                         EngineCounters& counters) {
    TraceCounters traced{};
    const auto limit = [&](std::size_t i) {
        return static_cast<double>(candidates.first[i]) * double(culling_slack);
    };
    const auto search = [&](const SceneData& prototype, std::span<Traveller* const> travellers) {
        float local_first[wave], local_second[wave];
        for (std::size_t k = 0; k < travellers.size(); ++k) {
            const Local& local = travellers[k]->local;
            const std::size_t i = travellers[k]->ray;
            const auto to_local = [&](float t) {
                return up(
                    local.to_local(before_of(rays, i) + static_cast<double>(t) + local.error));
            };
            lanes_->first[k] = local_first[k] = to_local(candidates.first[i]);
            lanes_->second[k] = local_second[k] = to_local(candidates.second[i]);
            lanes_->slot[k] = no_slot;
        }
        tracing_.method().trace.nearest(
            prototype.view(), prototype.listed_kinds(), nullptr, travellers.size(), rounded_,
            {lanes_->first, lanes_->second, lanes_->slot}, workspace_of(prototype), traced);
        for (std::size_t k = 0; k < travellers.size(); ++k)
            take_candidates(k, local_first[k], local_second[k], rays, candidates, *travellers[k]);
    };
    in_waves(count, rays, limit, search, [&](const Traveller& traveller) {
        if (traveller.found_slot != no_slot)
            candidates.slot[traveller.ray] = slot_of(traveller.found_copy, traveller.found_slot);
    });
    counters += traced;
}

void CopySearch::take_candidates(std::size_t lane, float first_limit, float second_limit,
                                 const RoundedRays& rays, const Candidates& candidates,
                                 Traveller& traveller) {
    const Local& local = traveller.local;
    float& first = candidates.first[traveller.ray];
    float& second = candidates.second[traveller.ray];
    const double before = before_of(rays, traveller.ray);
    const auto from_local = [&](float t) {
        return down(local.from_local(static_cast<double>(t)) - before - local.error);
    };
    // Beyond this, the search of the prototype may have skipped shapes.
    second = std::min(second, from_local(lanes_->first[lane] * culling_slack));
    const bool has_second = lanes_->second[lane] < second_limit;
    if (lanes_->slot[lane] == no_slot) {
        if (has_second) second = std::min(second, from_local(lanes_->second[lane]));
        return;
    }
    const float found = from_local(lanes_->first[lane]);
    // The previous candidate is the second one, unless two shapes of this copy precede it.
    if (has_second && lanes_->second[lane] < first_limit)
        second = std::min(second, from_local(lanes_->second[lane]));
    if (found < first) {
        second = std::min(second, first);
        first = found;
        traveller.found_copy = local.copy;
        traveller.found_slot = lanes_->slot[lane];
    } else {
        second = std::min(second, found);
    }
}

void CopySearch::occluded(std::size_t count, const RoundedRays& rays, const double* distance,
                          std::uint8_t* state, EngineCounters& counters) {
    TraceCounters traced{};
    const auto limit = [&](std::size_t i) {
        return state[i] == blocked ? -1.0 : distance[i] - before_of(rays, i);
    };
    const auto search = [&](const SceneData& prototype, std::span<Traveller* const> travellers) {
        std::uint8_t if_blocked[wave];
        for (std::size_t k = 0; k < travellers.size(); ++k) {
            const Local& local = travellers[k]->local;
            const double rest = distance[travellers[k]->ray] - local.start;
            const bool is_reached = rest + local.error > 0.0;
            // The kernels tolerate a relative error of the limit.
            const bool is_sharp = local.error <= 0x1p-26 * rest;
            lanes_->t_limit[k] = is_sharp
                                     ? static_cast<float>(std::min(rest / local.scale, 0x1p127))
                                     : up((rest + local.error) / local.scale);
            lanes_->state[k] = is_reached ? unblocked : blocked; // that is, not searched
            if_blocked[k] = !is_reached ? unblocked : is_sharp ? blocked : doubtful;
        }
        tracing_.method().trace.occluded(
            prototype.view(), prototype.listed_kinds(), nullptr, travellers.size(), rounded_,
            {lanes_->t_limit, lanes_->state}, workspace_of(prototype), traced);
        for (std::size_t k = 0; k < travellers.size(); ++k) {
            std::uint8_t& of_ray = state[travellers[k]->ray];
            of_ray =
                std::max(of_ray, lanes_->state[k] == blocked ? if_blocked[k] : lanes_->state[k]);
        }
    };
    in_waves(count, rays, limit, search, [](const Traveller&) {});
    counters += traced;
}

bool CopySearch::list(const RoundedRays& rays, std::size_t i, CandidateList& list,
                      TraceCounters& counters) {
    const double before = before_of(rays, i);
    bool has_room = true;
    const auto t_limit = [&] { return static_cast<double>(list.limit); };
    for_each_copy(rays, i, t_limit, [&](const Local& local) {
        const double rest = local.to_local(before + static_cast<double>(list.limit) + local.error);
        const float limit = std::max(up(rest), std::numeric_limits<float>::min());
        CandidateList copy_list{list.slot + list.count,
                                list.lower + list.count,
                                list.room - list.count,
                                0,
                                limit,
                                false};
        const SceneData& prototype = prototype_of(local);
        has_room = tracing_.method().refine.list_candidates(
            prototype.view(), prototype.listed_kinds(), rounded_, 0, workspace_of(prototype),
            copy_list, counters);
        for (std::size_t k = 0; k < copy_list.count; ++k) {
            copy_list.slot[k] = slot_of(local.copy, copy_list.slot[k]);
            copy_list.lower[k] = down(local.from_local(static_cast<double>(copy_list.lower[k])) -
                                      before - local.error);
        }
        list.count += copy_list.count;
        if (copy_list.limit < limit)
            list.limit =
                std::min(list.limit, up(local.from_local(static_cast<double>(copy_list.limit)) -
                                        before + local.error));
        return has_room;
    });
    return has_room;
}

void CopySearch::list_all(std::size_t count, const RoundedRays& rays, const float* t_limit,
                          PairList& list) {
    for (std::size_t i = 0; i < count; ++i) {
        if (!(t_limit[i] > 0.0F)) continue;
        const double before = before_of(rays, i);
        const auto limit = [&] { return static_cast<double>(t_limit[i]); };
        for_each_copy(rays, i, limit, [&](const Local& local) {
            lanes_->t_limit[0] =
                std::max(up(local.to_local(before + static_cast<double>(t_limit[i]) + local.error)),
                         std::numeric_limits<float>::min());
            const std::size_t used = std::min(list.count, list.room);
            PairList copy_list{list.ray + used, list.slot + used, list.room - used, 0};
            const SceneData& prototype = prototype_of(local);
            tracing_.method().refine.list_all(prototype.view(), prototype.listed_kinds(), 1,
                                              rounded_, lanes_->t_limit, workspace_of(prototype),
                                              copy_list);
            for (std::size_t k = 0; k < std::min(copy_list.count, copy_list.room); ++k) {
                copy_list.ray[k] = static_cast<std::uint32_t>(i);
                copy_list.slot[k] = slot_of(local.copy, copy_list.slot[k]);
            }
            list.count += copy_list.count;
            return true;
        });
    }
}

} // namespace raylane::simd
