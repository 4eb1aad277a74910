#pragma once

#include "simd/kernel/short_lanes.hpp"
#include "simd/kernel/trace/all.hpp"
#include "simd/kernel/trace/shadows.hpp"
#include "simd/kernel/trace/stream.hpp"
#include "simd/kernel/trace/towards.hpp"
#include "simd/kernel/trace/tree.hpp"
#include "simd/kernel/trace/walk.hpp"

namespace raylane::simd {

/// TraceKernels. This is where it is decided how rays are traced: bundles by groups, rays that are
/// near each other by lists, others in flight; and shape by shape where there is no hierarchy.
template <class Arch, class Method>
struct Trace : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using Rays = Group<Arch>;
    template <bool nearest_first>
    using Walk = GroupWalk<Arch, Method, nearest_first>;
    static constexpr std::size_t bunch = Walk<true>::bunch;

    /// Shapes that a group of rays to a light, and one that looks for the nearest, may have before
    /// it: as many as it takes for its rays to be done otherwise. What a float method makes of a
    /// ray may depend on that, so its groups are left alone; nor are they put in another order.
    static constexpr int unlimited = 0x7FFFFFFF;
    static constexpr int most_occluders = Method::certifies ? 512 : unlimited;
    static constexpr int most_candidates = Method::certifies ? 2048 : unlimited;

    static bool is_grouped(const Bundle* bundle) { return bundle != nullptr && !bundle->loose; }

    static void nearest(const SceneView& scene, std::uint32_t kind_bits, const Bundle* bundle,
                        std::size_t count, const RoundedRays& rays, const Candidates& candidates,
                        const Workspace& workspace, TraceCounters& counters) {
        if (!is_grouped(bundle)) {
            nearest_of_any(scene, kind_bits, bundle, 0, count, rays, candidates, workspace,
                           counters);
            return;
        }
        for (std::size_t begin = 0; begin < count; begin += Rays::most_rays) {
            const std::size_t end = Rays::lesser(begin + Rays::most_rays, count);
            Rays group;
            if (!group.enclose(rays, begin, end, *bundle, nullptr)) {
                nearest_of_any(scene, kind_bits, &neighbours, begin, end, rays, candidates,
                               workspace, counters);
                continue;
            }
            const Before before(candidates, begin, end - begin);
            if (!Walk<true>(scene, group, workspace, counters, most_candidates)
                     .go(kind_bits, [&](const auto& filter, std::uint32_t id, std::uint32_t slot,
                                        std::size_t which) {
                         return test(filter, id, slot, begin + bunch * which, end, rays,
                                     candidates);
                     })) {
                before.restore(candidates, begin); // or shapes would be met twice
                nearest_of_any(scene, kind_bits, &neighbours, begin, count, rays, candidates,
                               workspace, counters);
                return;
            }
            counters.in_frusta += end - begin;
        }
    }

    /// A group's candidates as they were.
    struct Before {
        Best best[Rays::most_rays];
        std::size_t count;

        Before(const Candidates& candidates, std::size_t begin, std::size_t size) : count(size) {
            for (std::size_t i = 0; i < count; ++i)
                best[i] = Leaf<Arch, Method>::best_of(candidates, begin + i);
        }
        void restore(const Candidates& candidates, std::size_t begin) const {
            for (std::size_t i = 0; i < count; ++i)
                Leaf<Arch, Method>::store(best[i], candidates, begin + i);
        }
    };

    /// One shape against a bunch of rays. Returns from which t on nothing matters to them.
    template <class Filter>
    static float test(const Filter& filter, std::uint32_t id, std::uint32_t slot, std::size_t from,
                      std::size_t end, const RoundedRays& stream, const Candidates& candidates) {
        F latest = zero<Arch>();
        for (std::size_t i = from; i < from + bunch && i < end; i += F::size) {
            PacketCandidates<Arch> found(candidates, i);
            found.test(filter, id, slot, Packet<Arch, Method>(stream, i));
            found.store(candidates, i);
            latest = xsimd::max(latest,
                                xsimd::select(S::first_lanes(end - i), found.first, zero<Arch>()));
        }
        return Lanes<Arch>::greatest(latest) * culling_slack;
    }

    static void occluded(const SceneView& scene, std::uint32_t kind_bits, const Bundle* bundle,
                         std::size_t count, const RoundedRays& rays, const Occlusions& occlusions,
                         const Workspace& workspace, TraceCounters& counters) {
        if (!is_grouped(bundle)) {
            occluded_of_any(scene, kind_bits, 0, count, rays, occlusions, workspace, counters);
        } else if (Method::certifies && Method::rounded_alone && bundle->towards &&
                   SortedTowards<Arch>::has_room(count, workspace)) {
            const SortedTowards<Arch> sorted(rays, occlusions, count, workspace);
            occluded_groups(scene, kind_bits, *bundle, count, sorted.rays, sorted.occlusions,
                            workspace, counters);
            sorted.hand_back(occlusions, count);
        } else {
            occluded_groups(scene, kind_bits, *bundle, count, rays, occlusions, workspace,
                            counters);
        }
    }

    static void occluded_groups(const SceneView& scene, std::uint32_t kind_bits,
                                const Bundle& bundle, std::size_t count, const RoundedRays& rays,
                                const Occlusions& occlusions, const Workspace& workspace,
                                TraceCounters& counters) {
        for (std::size_t begin = 0; begin < count; begin += Rays::most_rays) {
            const std::size_t end = Rays::lesser(begin + Rays::most_rays, count);
            Rays group;
            if (!group.enclose(rays, begin, end, bundle, occlusions.t_most)) {
                occluded_of_any(scene, kind_bits, begin, end, rays, occlusions, workspace,
                                counters);
                continue;
            }
            GroupOcclusions found(occlusions.state + begin, end - begin);
            const bool done = Walk<false>(scene, group, workspace, counters, most_occluders)
                                  .go(kind_bits, [&](const auto& filter, std::uint32_t id,
                                                     std::uint32_t slot, std::size_t which) {
                                      return block(scene, filter, id, slot, begin + bunch * which,
                                                   which, rays, occlusions, found);
                                  });
            found.store(occlusions.state + begin, end - begin);
            if (!done) { // nor will those that follow be, as a rule
                occluded_of_any(scene, kind_bits, begin, count, rays, occlusions, workspace,
                                counters);
                return;
            }
            counters.in_frusta += end - begin;
        }
    }

    /// Of a group's rays, by bunch, as bits.
    struct GroupOcclusions {
        std::uint32_t blocked_rays[16], doubtful_rays[16] = {};

        /// Lanes that are not there are blocked.
        GroupOcclusions(const std::uint8_t* state, std::size_t count) {
            for (std::size_t k = 0; k < 16; ++k)
                blocked_rays[k] = 0xFFFF;
            for (std::size_t k = 0; k < count / 16; ++k)
                blocked_rays[k] = ShortLanes<Arch>::equal_16(state + 16 * k, blocked);
            for (std::size_t i = count / 16 * 16; i < count; ++i)
                if (state[i] != blocked) blocked_rays[i / 16] &= ~(1U << i % 16);
        }
        void store(std::uint8_t* state, std::size_t count) const {
            for (std::size_t k = 0; k < count / 16; ++k) {
                ShortLanes<Arch>::raise_16(state + 16 * k, doubtful_rays[k], doubtful);
                ShortLanes<Arch>::raise_16(state + 16 * k, blocked_rays[k], blocked);
            }
            for (std::size_t i = count / 16 * 16; i < count; ++i) {
                const bool is_blocked = (blocked_rays[i / 16] >> i % 16 & 1) != 0;
                const bool is_doubtful = (doubtful_rays[i / 16] >> i % 16 & 1) != 0;
                const std::uint8_t found = is_blocked ? blocked : is_doubtful ? doubtful : open;
                state[i] = found > state[i] ? found : state[i];
            }
        }
    };

    /// One shape against a bunch of shadow rays, to which nothing matters once all of them are
    /// blocked.
    template <class Filter>
    static float block(const SceneView& scene, const Filter& filter, std::uint32_t id,
                       std::uint32_t slot, std::size_t from, std::size_t which,
                       const RoundedRays& stream, const Occlusions& occlusions,
                       GroupOcclusions& group) {
        const bool plain = S::is_plain(scene, slot);
        for (std::size_t lane = 0; lane < bunch; lane += F::size) {
            PacketOcclusions<Arch> found(occlusions, from + lane);
            found.test(filter, id, plain, Packet<Arch, Method>(stream, from + lane));
            group.blocked_rays[which] |= found.sure << lane;
            group.doubtful_rays[which] |= found.some << lane;
        }
        return group.blocked_rays[which] == 0xFFFF ? -1.0F : __builtin_inff();
    }

    /// Streams from one ray on.
    static RoundedRays from_ray(const RoundedRays& rays, std::size_t begin) {
        RoundedRays result = rays;
        for (int axis = 0; axis < 3; ++axis) {
            result.origin[axis] += begin;
            result.direction[axis] += begin;
            result.meant_origin[axis] += begin;
            result.meant_direction[axis] += begin;
        }
        result.slack += begin;
        result.departed_first += begin;
        result.departed_last += begin;
        return result;
    }

    /// Rays that have no more in common than `bundle` says, which is loose or null. However many
    /// there are, the way is the same: what a float method makes of a ray then does not depend on
    /// who goes with it.
    static void nearest_of_any(const SceneView& scene, std::uint32_t kind_bits,
                               const Bundle* bundle, std::size_t begin, std::size_t end,
                               const RoundedRays& rays, const Candidates& candidates,
                               const Workspace& workspace, TraceCounters& counters) {
        const RoundedRays some = from_ray(rays, begin);
        const Candidates theirs{candidates.first + begin, candidates.second + begin,
                                candidates.slot + begin};
        const std::size_t count = end - begin;
        if (kind_bits != 0)
            TraceAll<Arch, Method>::nearest(scene, kind_bits, count, some, theirs, counters);
        if (workspace.key == nullptr) {
            counters.one_by_one += count;
        } else if ((bundle != nullptr || scene.small) && count <= workspace.capacity) {
            counters.in_streams += count;
            TraceStream<Arch, Method>::nearest(scene, count, some, theirs, workspace, counters);
        } else {
            counters.in_flight += count;
            TraceTree<Arch, Method>::nearest(scene, count, some, theirs, workspace, counters);
        }
    }

    static void occluded_of_any(const SceneView& scene, std::uint32_t kind_bits, std::size_t begin,
                                std::size_t end, const RoundedRays& rays,
                                const Occlusions& occlusions, const Workspace& workspace,
                                TraceCounters& counters) {
        const RoundedRays some = from_ray(rays, begin);
        const Occlusions theirs{occlusions.t_most + begin, occlusions.state + begin};
        if (kind_bits != 0)
            TraceAll<Arch, Method>::occluded(scene, kind_bits, end - begin, some, theirs, counters);
        if (workspace.key == nullptr) {
            counters.one_by_one += end - begin;
        } else {
            counters.in_flight += end - begin;
            TraceShadows<Arch, Method>::occluded(scene, end - begin, some, theirs, workspace,
                                                 counters);
        }
    }

    static constexpr TraceKernels table() { return {nearest, occluded}; }
};

} // namespace raylane::simd
