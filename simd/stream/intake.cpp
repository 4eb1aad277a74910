#include "simd/stream/intake.hpp"

#include "simd/query/as_core.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

namespace raylane::simd {

namespace {

/// Returns the columns from lane `to` on. `to` is a multiple of 16.
StreamRays from(StreamRays rays, std::size_t to) {
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] += to;
        rays.direction[axis] += to;
        rays.exact_direction[axis] += to;
    }
    for (double** const column : {&rays.exact_length, &rays.unit, &rays.per_unit, &rays.t_after,
                                  &rays.start, &rays.t_limit})
        *column += to;
    rays.bits += to;
    return rays;
}

} // namespace

void StreamIntake::take_from(Arena& arena) {
    paths_.take_from(arena, capacity_, false, /*for_others=*/true);
    taken_ = {{paths_.origin[0], paths_.origin[1], paths_.origin[2]},
              {paths_.direction[0], paths_.direction[1], paths_.direction[2]},
              {paths_.exact_direction[0], paths_.exact_direction[1], paths_.exact_direction[2]},
              paths_.exact_length,
              arena.take<double>(capacity_),
              arena.take<double>(capacity_),
              paths_.t_after,
              paths_.start,
              arena.take<double>(capacity_),
              paths_.origin_bits};
}

template <class Real>
RayStream<Real> StreamIntake::take(const RayStream<Real>& rays, std::size_t first) {
    paths_.t_after = taken_.t_after;
    paths_.start = taken_.start;
    const std::size_t left = rays.count - first;
    std::size_t count = std::min(left, together);
    take(part_of(rays, first, count), count, 0);
    const bool coherent = tracing_.precision == core::Precision::exact &&
                          kernels().find_coherence(count, taken_, scene_.radius(), in_common_);
    coherence_ = coherent ? &in_common_ : nullptr;
    if (!coherent && count < std::min(left, capacity_)) {
        const std::size_t more = std::min(left, capacity_) - count;
        take(part_of(rays, first + count, more), more, count);
        count += more;
    }
    // Only Precision::exact has lower limits in its search. Other precisions check the hits that
    // they find.
    if (tracing_.precision != core::Precision::exact || rays.t_min == nullptr)
        paths_.t_after = paths_.start = nullptr;
    paths_.count = count;
    return part_of(rays, first, count);
}

/// Takes all these rays into the lanes from `to` on.
template <class Real>
void StreamIntake::take(const RayStream<Real>& rays, std::size_t count, std::size_t to) {
    std::size_t none = 0;
    if constexpr (std::is_same_v<Real, float>)
        none = kernels().take(rays, from(taken_, to));
    else
        none = kernels().take_doubles(rays, from(taken_, to));
    if (rays.origin_shape == nullptr)
        for (std::uint32_t* const column :
             {paths_.origin_first, paths_.origin_last, paths_.origin_slot})
            std::fill_n(column + to, count, no_slot);
    else
        start_on(rays, count, to);
    if (none != 0) stand_in(to, to + count);
}

template <class Real>
void start_on(const Paths& paths, std::size_t lane, const SceneData& scene,
              std::span<const std::uint32_t> slots, const RayStream<Real>& rays, std::size_t i) {
    const core::ShapeId shape = rays.origin_shape[i];
    const std::uint32_t slot = shape < slots.size() ? slots[shape] : no_slot;
    if (slot == no_slot) return paths.start_nowhere(lane, lane + 1);
    const bool inward = (rays.origin_inward != nullptr && rays.origin_inward[i] != 0) !=
                        scene.scene().solids().is_reversed(shape);
    const std::uint32_t face = rays.origin_face != nullptr ? rays.origin_face[i] : 0;
    paths.start_on(lane, slot, scene.shape_named(shape, slot), face | (inward ? hit_entering : 0),
                   /*through=*/true);
}

template <class Real>
void StreamIntake::start_on(const RayStream<Real>& rays, std::size_t count, std::size_t to) {
    const std::span<const std::uint32_t> slots = shapes_.slots();
    constexpr std::size_t ahead = 16;
    for (std::size_t i = 0; i < count; ++i) {
        if (i + ahead < count && rays.origin_shape[i + ahead] < slots.size())
            __builtin_prefetch(&slots[rays.origin_shape[i + ahead]]);
        const std::uint32_t tie_counts = paths_.origin_bits[to + i];
        simd::start_on(paths_, to + i, scene_, slots, rays, i);
        paths_.origin_bits[to + i] |= tie_counts;
    }
}

/// Replaces each invalid ray by a copy of a valid one, so that it does not destroy the property
/// that the valid rays share (Coherence). Does nothing if no ray is valid.
void StreamIntake::stand_in(std::size_t begin, std::size_t end) {
    std::size_t other = begin;
    while (other < end && !is_ray(other))
        ++other;
    if (other == end) return;
    for (std::size_t lane = begin; lane < end; ++lane)
        if (is_ray(lane))
            other = lane;
        else
            paths_.copy_ray(paths_, other, lane);
}

void StreamIntake::keep(const std::uint32_t* lanes, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
        paths_.copy_ray(paths_, lanes[k], k);
        for (double* const column : {taken_.unit, taken_.per_unit, taken_.t_limit})
            column[k] = column[lanes[k]];
    }
    paths_.count = count;
}

template <class Real>
LoneRay StreamIntake::lone(const RayStream<Real>& rays, std::size_t i, std::size_t lane) const {
    const double unit = taken_.unit[lane];
    constexpr Real endless = std::numeric_limits<Real>::infinity();
    const Real t_min = rays.t_min != nullptr ? std::max(Real(0), rays.t_min[i]) : Real(0);
    const Real t_max = rays.t_max != nullptr ? rays.t_max[i] : endless;
    const auto beyond = static_cast<double>(std::nextafter(t_max, endless));
    return {ray_of(paths_, lane),
            origin_surfaces_of(scene_, paths_, lane),
            std::ilogb(unit),
            static_cast<double>(t_min),
            static_cast<double>(t_max),
            std::is_same_v<Real, float>,
            t_max < std::numeric_limits<Real>::max() ? beyond / unit
                                                     : std::numeric_limits<double>::infinity()};
}

template void start_on(const Paths&, std::size_t, const SceneData&, std::span<const std::uint32_t>,
                       const RayStream<float>&, std::size_t);
template void start_on(const Paths&, std::size_t, const SceneData&, std::span<const std::uint32_t>,
                       const RayStream<double>&, std::size_t);
template RayStream<float> StreamIntake::take(const RayStream<float>&, std::size_t);
template RayStream<double> StreamIntake::take(const RayStream<double>&, std::size_t);
template LoneRay StreamIntake::lone(const RayStream<float>&, std::size_t, std::size_t) const;
template LoneRay StreamIntake::lone(const RayStream<double>&, std::size_t, std::size_t) const;

} // namespace raylane::simd
