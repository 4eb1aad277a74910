#pragma once

#include "simd/kernel/traverse/box_ray.hpp"
#include "simd/kernel/traverse/cut.hpp"
#include "simd/kernel/traverse/rays.hpp"

namespace raylane::simd {

/// Candidate for the nearest crossing of one ray.
struct Best {
    float first, second;
    std::uint32_t slot;
};

/// Record of one ray that traverses the hierarchy in a list.
struct alignas(64) ListRecord {
    BoxRay box;
    Best best;
};
static_assert(sizeof(ListRecord) == list_record_bytes);

/// The shapes of a block that may be crossed, with lower bounds of t.
struct LeafHits {
    std::uint32_t lanes;
    alignas(64) float t[16]; ///< valid in these lanes
};

/// Tests of one ray against the shapes of a block, which is given as PlainLanes or PackedLanes.
template <class Arch, class Method>
struct Leaf : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    static Best best_of(const Candidates& candidates, std::size_t i) {
        return {candidates.first[i], candidates.second[i], candidates.slot[i]};
    }
    static void store(const Best& best, const Candidates& candidates, std::size_t i) {
        candidates.first[i] = best.first;
        candidates.second[i] = best.second;
        candidates.slot[i] = best.slot;
    }

    /// True for shapes that the ray does not start on.
    static M elsewhere(const F& ids, const RoundedRays& rays, std::size_t i) {
        return ~Lanes<Arch>::in_range(ids, S::broadcast_bits(rays.origin_first[i]),
                                      S::broadcast_bits(rays.origin_last[i]));
    }

    /// Returns the shapes that may be met, as bits, by a test that costs less than their bounds.
    template <class Filter, class Lanes16>
    [[gnu::always_inline]] static std::uint32_t may_meet(const Lanes16& block,
                                                         const RoundedRays& rays, std::size_t i) {
        std::uint32_t mask = 0;
        for (int from = 0, end = block.end(); from < end; from += static_cast<int>(F::size)) {
            M lanes = elsewhere(block.ids(from), rays, i);
            if constexpr (has_may_meet<Filter, typename Method::Rays>)
                lanes = lanes & Filter(block.reader(from)).may_meet(Method::broadcast(rays, i));
            else
                lanes = lanes & S::filled(block.ids(from));
            mask |= Lanes<Arch>::bits(lanes) << from;
        }
        return mask;
    }

    /// Finds the shapes that may be crossed before `second`, where `cut` does not remove them.
    template <class Filter, class Lanes16>
    [[gnu::always_inline]] static void find(const Lanes16& block, const ClipPlanesView* cut,
                                            const RoundedRays& rays, std::size_t i, float second,
                                            LeafHits& hits) {
        const typename Method::Rays ray = Method::broadcast(rays, i);
        hits.lanes = 0;
        for (int from = 0, end = block.end(); from < end; from += static_cast<int>(F::size)) {
            const Filter filter(block.reader(from));
            const Bounds<Arch> bounds = bounds_of(filter, ray, rays, i, cut);
            const M counts =
                bounds.possible & elsewhere(block.ids(from), rays, i) & (bounds.lower < F(second));
            hits.lanes |= Lanes<Arch>::bits(counts) << from;
            bounds.lower.store_unaligned(hits.t + from);
        }
    }

    static CutRays<Arch> to_cut(const typename Method::Rays& ray, const RoundedRays& rays,
                                std::size_t i) {
        return {ray, S::broadcast_bits(rays.origin_first[i]),
                S::broadcast_bits(rays.origin_last[i])};
    }
    template <class Filter>
    [[gnu::always_inline]] static Bounds<Arch>
    bounds_of(const Filter& filter, const typename Method::Rays& ray, const RoundedRays& rays,
              std::size_t i, const ClipPlanesView* cut) {
        if constexpr (knows_cuts<Method>)
            if (cut != nullptr) return bounds_of_cut<Arch>(filter, to_cut(ray, rays, i), *cut);
        return filter.bounds(ray);
    }

    /// Updates the candidate with at least one hit.
    [[gnu::always_inline]] static void take(const LeafHits& hits, std::uint32_t first_slot,
                                            Best& best) {
        for (std::uint32_t lanes = hits.lanes; lanes != 0; lanes &= lanes - 1) {
            const int lane = __builtin_ctz(lanes);
            take(hits.t[lane], first_slot + static_cast<std::uint32_t>(lane), best);
        }
    }

    /// Same for one crossing.
    [[gnu::always_inline]] static void take(float t, std::uint32_t slot, Best& best) {
        const bool nearer = t < best.first;
        const float behind = t < best.second ? t : best.second;
        best.second = nearer ? best.first : behind;
        best.slot = nearer ? slot : best.slot;
        best.first = nearer ? t : best.first;
    }

    template <class Filter, class Lanes16>
    [[gnu::always_inline]] static std::uint8_t
    occluded(const SceneView& scene, const TableView& table, std::uint32_t number,
             const Lanes16& block, const RoundedRays& rays, std::size_t i, float t_limit) {
        const typename Method::Rays ray = Method::broadcast(rays, i);
        const std::uint32_t slot = table.first_slot + 16 * number;
        const std::uint32_t plain = S::plain_lanes(scene, slot);
        const std::uint32_t counts = knows_cuts<Method> ? ~S::only_cut_lanes(scene, slot) : ~0U;
        const ClipPlanesView* cut = cut_of<Method>(scene, slot);
        std::uint8_t state = unblocked;
        for (int from = 0, end = block.end(); from < end; from += static_cast<int>(F::size)) {
            const Filter filter(block.reader(from));
            std::uint32_t asked =
                Lanes<Arch>::bits(elsewhere(block.ids(from), rays, i)) & counts >> from;
            const Obstacle<Arch> obstacle = obstacle_of<Arch>(
                filter, ray, asked, F(t_limit * perhaps_within), F(t_limit * surely_within));
            if constexpr (knows_cuts<Method>)
                if (cut != nullptr) {
                    const std::uint32_t perhaps = Lanes<Arch>::bits(may_cross_cut<Arch>(
                        filter, to_cut(ray, rays, i), *cut, F(t_limit * perhaps_within)));
                    if ((perhaps & asked & ~(plain >> from)) != 0) state = doubtful;
                    asked &= plain >> from;
                }
            if ((Lanes<Arch>::bits(obstacle.possible) & asked) == 0) continue;
            if ((Lanes<Arch>::bits(obstacle.possible & obstacle.certain) & asked & plain >> from) !=
                0)
                return blocked;
            state = doubtful;
        }
        return state;
    }
};

} // namespace raylane::simd
