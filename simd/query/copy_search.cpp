#include "simd/query/copy_search.hpp"

#include "core/numbers/infinity.hpp"
#include "simd/query/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raylane::simd {

namespace {

/// Copies whose places are kept ready for rays; a power of two.
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
    : scene_(scene), tracing_(tracing), walk_(*scene.scene().copies()), placed_(places),
      ray_(std::make_unique<Columns>()) {
    for (int axis = 0; axis < 3; ++axis) {
        rounded_.origin[axis] = ray_->origin[axis];
        rounded_.direction[axis] = ray_->direction[axis];
        rounded_.exact_origin[axis] = ray_->exact_origin[axis];
        rounded_.exact_direction[axis] = ray_->exact_direction[axis];
    }
    rounded_.slack = ray_->slack;
    rounded_.origin_first = ray_->origin_first;
    rounded_.origin_last = ray_->origin_last;
}

void CopySearch::take_from(Arena& arena) {
    const SceneData* deepest = nullptr;
    for (const auto& prototype : scene_.prototypes())
        if (deepest == nullptr || prototype->view().tree_depth > deepest->view().tree_depth)
            deepest = prototype.get();
    workspace_ = workspace_for(*deepest, arena, packet);
}

const CopySearch::Placed& CopySearch::placed_at(std::uint32_t copy) {
    Placed& placed = placed_[copy % places];
    if (placed.copy == copy) return placed;
    const core::Copies& copies = *scene_.scene().copies();
    const core::Copies::Copy of = copies.copy_at(copy);
    const core::Placement& placement = copies.placement(copy);
    const core::Placer placer(placement);
    placed.copy = copy;
    placed.set = static_cast<std::uint32_t>(&of.set - copies.sets().data());
    placed.first_id = core::Copies::first_id_of(of);
    for (int i = 0; i < 3; ++i)
        placed.rows[i] = placer.row(i);
    placed.translate = placement.translate;
    placed.scale = placement.scale;
    return placed;
}

template <class Limit, class Visit>
void CopySearch::for_each_copy(const RoundedRays& rays, std::size_t i, const Limit& t_limit,
                               const Visit& visit) {
    const core::Vec3d origin = vector_at(rays.exact_origin, i);
    const core::Vec3d direction = vector_at(rays.exact_direction, i);
    const double before = before_of(rays, i);
    // The start is moved along the ray, with a rounding of each product and sum, and of the
    // direction.
    const double size = std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z) + before;
    walk_.start({before == 0.0 ? origin : core::Vec3d(origin + before * direction), direction},
                before == 0.0 ? 0.0 : 0x1p-49 * size);
    std::uint32_t copy = 0;
    while (walk_.next(t_limit(), copy)) {
        const Local local = place(rays, i, copy);
        if (!local.is_beside && !visit(local)) return;
    }
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
CopySearch::Local CopySearch::place(const RoundedRays& rays, std::size_t i, std::uint32_t copy) {
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
    Local local{&placed, placed.scale * start, placed.scale, 0x1p-45 * size, false};
    double moved = local.error * shrink;
    for (int axis = 0; axis < 3; ++axis) {
        const auto nearest = static_cast<float>(origin[axis]);
        moved += std::abs(origin[axis] - static_cast<double>(nearest));
        ray_->origin[axis][0] = nearest;
        ray_->direction[axis][0] = static_cast<float>(direction[axis]);
        ray_->exact_origin[axis][0] = origin[axis];
        ray_->exact_direction[axis][0] = direction[axis];
    }
    ray_->slack[0] = static_cast<float>(moved * (1.0 + 0x1p-12)) +
                     least_slack(prototype_of(local).view().rounding);
    local.is_beside = misses(set.prototype->hierarchy().bounds, origin, direction,
                             2.0 * static_cast<double>(ray_->slack[0]));
    const bool is_inside =
        rays.origin_first[i] != no_slot && rays.origin_first[i] - placed.first_id < set.shape_count;
    ray_->origin_first[0] = is_inside ? rays.origin_first[i] - placed.first_id : no_slot;
    ray_->origin_last[0] = is_inside ? rays.origin_last[i] - placed.first_id : no_slot;
    return local;
}

std::uint32_t CopySearch::slot_of(std::uint32_t copy, std::uint32_t slot) const {
    return scene_.slot_in_copy(scene_.scene().copies()->copy_at(copy), slot);
}

void CopySearch::nearest(std::size_t count, const RoundedRays& rays, const Candidates& candidates,
                         EngineCounters& counters) {
    TraceCounters traced{};
    for (std::size_t i = 0; i < count; ++i)
        nearest_of(rays, i, candidates, traced);
    counters += traced;
}

void CopySearch::nearest_of(const RoundedRays& rays, std::size_t i, const Candidates& candidates,
                            TraceCounters& counters) {
    const double before = before_of(rays, i);
    float& first = candidates.first[i];
    float& second = candidates.second[i];
    const auto limit = [&] { return static_cast<double>(first) * double(culling_slack); };
    std::uint32_t copy = no_slot, slot = no_slot; // of the candidate, if it is in a copy
    for_each_copy(rays, i, limit, [&](const Local& local) {
        const auto to_local = [&](float t) {
            return up(local.to_local(before + static_cast<double>(t) + local.error));
        };
        const auto from_local = [&](float t) {
            return down(local.from_local(static_cast<double>(t)) - before - local.error);
        };
        const float local_first = to_local(first), local_second = to_local(second);
        ray_->first[0] = local_first;
        ray_->second[0] = local_second;
        ray_->slot[0] = no_slot;
        const SceneData& prototype = prototype_of(local);
        tracing_.method().trace.nearest(prototype.view(), prototype.listed_kinds(), nullptr, 1,
                                        rounded_, {ray_->first, ray_->second, ray_->slot},
                                        workspace_of(prototype), counters);
        // Beyond this, the search of the prototype may have skipped shapes.
        second = std::min(second, from_local(ray_->first[0] * culling_slack));
        const bool has_second = ray_->second[0] < local_second;
        if (ray_->slot[0] == no_slot) {
            if (has_second) second = std::min(second, from_local(ray_->second[0]));
            return true;
        }
        const float found = from_local(ray_->first[0]);
        // The previous candidate is the second one, unless two shapes of this copy precede it.
        if (has_second && ray_->second[0] < local_first)
            second = std::min(second, from_local(ray_->second[0]));
        if (found < first) {
            second = std::min(second, first);
            first = found;
            copy = local.placed->copy;
            slot = ray_->slot[0];
        } else {
            second = std::min(second, found);
        }
        return true;
    });
    if (slot != no_slot) candidates.slot[i] = slot_of(copy, slot);
}

void CopySearch::occluded(std::size_t count, const RoundedRays& rays, const double* distance,
                          std::uint8_t* state, EngineCounters& counters) {
    TraceCounters traced{};
    for (std::size_t i = 0; i < count; ++i)
        if (state[i] != blocked) state[i] = occluded_of(rays, i, distance[i], state[i], traced);
    counters += traced;
}

std::uint8_t CopySearch::occluded_of(const RoundedRays& rays, std::size_t i, double distance,
                                     std::uint8_t state, TraceCounters& counters) {
    const double before = before_of(rays, i);
    const auto limit = [&] { return distance - before; };
    for_each_copy(rays, i, limit, [&](const Local& local) {
        const double rest = distance - local.start;
        if (rest + local.error <= 0.0) return true;
        // The kernels tolerate a relative error of the limit.
        const bool is_sharp = local.error <= 0x1p-26 * rest;
        ray_->t_limit[0] = is_sharp ? static_cast<float>(std::min(rest / local.scale, 0x1p127))
                                    : up((rest + local.error) / local.scale);
        ray_->state[0] = unblocked;
        const SceneData& prototype = prototype_of(local);
        tracing_.method().trace.occluded(prototype.view(), prototype.listed_kinds(), nullptr, 1,
                                         rounded_, {ray_->t_limit, ray_->state},
                                         workspace_of(prototype), counters);
        if (!is_sharp && ray_->state[0] == blocked) ray_->state[0] = doubtful;
        state = std::max(state, ray_->state[0]);
        return state != blocked;
    });
    return state;
}

bool CopySearch::list(const RoundedRays& rays, std::size_t i, CandidateList& list,
                      TraceCounters& counters) {
    const double before = before_of(rays, i);
    bool has_room = true;
    const auto t_limit = [&] { return static_cast<double>(list.limit); };
    for_each_copy(rays, i, t_limit, [&](const Local& local) {
        const double rest = local.to_local(before + static_cast<double>(list.limit) + local.error);
        const float limit = std::max(up(rest), std::numeric_limits<float>::min());
        CandidateList here{list.slot + list.count,
                           list.lower + list.count,
                           list.room - list.count,
                           0,
                           limit,
                           false};
        const SceneData& prototype = prototype_of(local);
        has_room = tracing_.method().refine.list_candidates(
            prototype.view(), prototype.listed_kinds(), rounded_, 0, workspace_of(prototype), here,
            counters);
        for (std::size_t k = 0; k < here.count; ++k) {
            here.slot[k] = slot_of(local.placed->copy, here.slot[k]);
            here.lower[k] =
                down(local.from_local(static_cast<double>(here.lower[k])) - before - local.error);
        }
        list.count += here.count;
        if (here.limit < limit)
            list.limit = std::min(list.limit, up(local.from_local(static_cast<double>(here.limit)) -
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
            ray_->t_limit[0] =
                std::max(up(local.to_local(before + static_cast<double>(t_limit[i]) + local.error)),
                         std::numeric_limits<float>::min());
            const std::size_t used = std::min(list.count, list.room);
            PairList here{list.ray + used, list.slot + used, list.room - used, 0};
            const SceneData& prototype = prototype_of(local);
            tracing_.method().refine.list_all(prototype.view(), prototype.listed_kinds(), 1,
                                              rounded_, ray_->t_limit, workspace_of(prototype),
                                              here);
            for (std::size_t k = 0; k < std::min(here.count, here.room); ++k) {
                here.ray[k] = static_cast<std::uint32_t>(i);
                here.slot[k] = slot_of(local.placed->copy, here.slot[k]);
            }
            list.count += here.count;
            return true;
        });
    }
}

} // namespace raylane::simd
