#pragma once

#include "simd/kernel/trace/all.hpp"
#include "simd/kernel/trace/group.hpp"

namespace raylane::simd {

/// TraceKernels. Bundles of rays a group at a time: a node or a block is visited once for up to 256
/// rays, and a shape is tested against those bunches of 16 that may meet it.
template <class Arch, class Method>
struct Trace : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using Rays = Group<Arch>;
    static constexpr std::size_t bunch = 16;

    /// What the sixteen bunches ask: the t from which on nothing matters to them.
    struct Limits {
        float t[16];
        float largest;

        explicit Limits(std::size_t bunches) {
            for (std::size_t which = 0; which < 16; ++which)
                t[which] = which < bunches ? __builtin_inff() : -1.0F;
            update();
        }

        void update() {
            largest = t[0];
            for (int i = 1; i < 16; ++i)
                largest = t[i] > largest ? t[i] : largest;
        }
    };

    static bool has_tree(const Pending& pending) { return pending.t != nullptr; }

    /// Visits blocks in the order of their distance: block(kind, number).
    template <class Visit>
    static void walk(const SceneView& scene, std::uint32_t kind_bits, const Rays& group,
                     const Limits& limits, const Pending& pending, TraceCounters& counters,
                     const Visit& visit_block) {
        for (; kind_bits != 0; kind_bits &= kind_bits - 1) {
            const auto kind = static_cast<KindNumber>(__builtin_ctz(kind_bits));
            for (std::uint32_t block = 0; block < scene.tables[kind].block_count; ++block)
                visit_block(kind, block);
        }
        if (!has_tree(pending)) return;
        int size = 0;
        std::uint32_t child = 0;
        for (;;) {
            if ((child & child_is_block) != 0) {
                visit_block(TraceTree<Arch, Method>::kind_of(child), child & child_index);
            } else {
                ++counters.nodes;
                const int before = size;
                const NodeView& node = scene.nodes[child];
                for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
                    F near = zero<Arch>();
                    std::uint32_t bits = group.enter(node, from, F(limits.largest), near);
                    float near_t[F::size];
                    near.store_unaligned(near_t);
                    for (; bits != 0; bits &= bits - 1) {
                        const int slot = __builtin_ctz(bits);
                        int place = size++;
                        for (; place > before && pending.t[place - 1] < near_t[slot]; --place) {
                            pending.t[place] = pending.t[place - 1];
                            pending.child[place] = pending.child[place - 1];
                        }
                        pending.t[place] = near_t[slot];
                        pending.child[place] = node.children[from + slot];
                    }
                }
            }
            while (size > 0 && pending.t[size - 1] > limits.largest)
                --size;
            if (size == 0) return;
            child = pending.child[--size];
        }
    }

    /// Calls visit(filter, id, slot, bunches) for the shapes of a block that the group may meet.
    template <class Visit>
    static void for_each_shape(const SceneView& scene, KindNumber kind, std::uint32_t number,
                               const Rays& group, const Limits& limits, const Visit& visit) {
        const TableView& table = scene.tables[kind];
        const float* block = S::block_of(table, number);
        const auto rows = S::rows_of(block);
        const std::uint32_t* ids = S::ids_of(table, block);
        BlockSpheres<Arch> spheres;
        spheres.enclose(kind, rows);
        std::uint32_t shapes = 0;
        for (int from = 0; from < 16; from += static_cast<int>(F::size))
            shapes |= group.meet(spheres.load(from)) << from;
        if (shapes == 0) return;
        Method::with_filter(kind, [&]<class Filter>() {
            for (; shapes != 0; shapes &= shapes - 1) {
                const int lane = __builtin_ctz(shapes);
                const SphereAround<Arch> sphere = spheres.broadcast(lane);
                std::uint32_t bunches = 0;
                for (std::size_t from = 0; from < 16; from += F::size)
                    bunches |= group.bunches_that_meet(sphere, from, S::load(limits.t + from))
                               << from;
                if (bunches == 0) continue;
                visit(Filter(BroadcastReader<Arch>(rows, lane)), ids[lane],
                      table.first_slot + 16 * number + static_cast<std::uint32_t>(lane), bunches);
            }
        });
    }

    /// Tests a group: visit(filter, id, slot, from), for the bunch that starts at ray `from`,
    /// returns from which t on nothing matters to it.
    template <class Visit>
    static void for_each_bunch(const SceneView& scene, std::uint32_t kind_bits, const Rays& group,
                               std::size_t begin, const Pending& pending, TraceCounters& counters,
                               const Visit& visit) {
        Limits limits(group.bunches);
        walk(scene, kind_bits, group, limits, pending, counters,
             [&](KindNumber kind, std::uint32_t number) {
                 bool changed = false;
                 for_each_shape(scene, kind, number, group, limits,
                                [&](const auto& filter, std::uint32_t id, std::uint32_t slot,
                                    std::uint32_t bunches) {
                                    for (; bunches != 0; bunches &= bunches - 1) {
                                        const int which = __builtin_ctz(bunches);
                                        const std::size_t from =
                                            begin + bunch * static_cast<std::size_t>(which);
                                        const float limit = visit(filter, id, slot, from);
                                        counters.shapes += bunch;
                                        changed = changed || limit != limits.t[which];
                                        limits.t[which] = limit;
                                    }
                                });
                 if (changed) limits.update();
             });
    }

    static void nearest(const SceneView& scene, std::uint32_t kind_bits, const Bundle* bundle,
                        std::size_t count, const RoundedRays& rays, const Candidates& candidates,
                        const Pending& pending, TraceCounters& counters) {
        if (bundle == nullptr) {
            nearest_one_by_one(scene, kind_bits, 0, count, rays, candidates, pending, counters);
            return;
        }
        for (std::size_t begin = 0; begin < count; begin += Rays::most_rays) {
            const std::size_t end = Rays::lesser(begin + Rays::most_rays, count);
            Rays group;
            if (group.enclose(rays, begin, end, *bundle, nullptr))
                for_each_bunch(scene, kind_bits, group, begin, pending, counters,
                               [&](const auto& filter, std::uint32_t id, std::uint32_t slot,
                                   std::size_t from) {
                                   return test(filter, id, slot, from, end, rays, candidates);
                               });
            else
                nearest_one_by_one(scene, kind_bits, begin, end, rays, candidates, pending,
                                   counters);
        }
    }

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
                         const Pending& pending, TraceCounters& counters) {
        if (bundle == nullptr) {
            occluded_one_by_one(scene, kind_bits, 0, count, rays, occlusions, pending, counters);
            return;
        }
        for (std::size_t begin = 0; begin < count; begin += Rays::most_rays) {
            const std::size_t end = Rays::lesser(begin + Rays::most_rays, count);
            Rays group;
            if (group.enclose(rays, begin, end, *bundle, occlusions.t_most))
                for_each_bunch(scene, kind_bits, group, begin, pending, counters,
                               [&](const auto& filter, std::uint32_t id, std::uint32_t slot,
                                   std::size_t from) {
                                   return block(scene, filter, id, slot, from, end, rays,
                                                occlusions);
                               });
            else
                occluded_one_by_one(scene, kind_bits, begin, end, rays, occlusions, pending,
                                    counters);
        }
    }

    /// The same for shadow rays, to which nothing matters once all of them are blocked.
    template <class Filter>
    static float block(const SceneView& scene, const Filter& filter, std::uint32_t id,
                       std::uint32_t slot, std::size_t from, std::size_t end,
                       const RoundedRays& stream, const Occlusions& occlusions) {
        const bool plain = S::is_plain(scene, slot);
        bool all_blocked = true;
        for (std::size_t i = from; i < from + bunch && i < end; i += F::size) {
            PacketOcclusions<Arch> found(occlusions, i);
            found.test(filter, id, plain, Packet<Arch, Method>(stream, i));
            if (!found.store(occlusions.state + i, end - i)) all_blocked = false;
        }
        return all_blocked ? -1.0F : __builtin_inff();
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

    static void nearest_one_by_one(const SceneView& scene, std::uint32_t kind_bits,
                                   std::size_t begin, std::size_t end, const RoundedRays& rays,
                                   const Candidates& candidates, const Pending& pending,
                                   TraceCounters& counters) {
        const RoundedRays some = from_ray(rays, begin);
        const Candidates theirs{candidates.first + begin, candidates.second + begin,
                                candidates.slot + begin};
        if (kind_bits != 0)
            TraceAll<Arch, Method>::nearest(scene, kind_bits, end - begin, some, theirs, counters);
        if (has_tree(pending))
            TraceTree<Arch, Method>::nearest(scene, end - begin, some, theirs, pending, counters);
    }

    static void occluded_one_by_one(const SceneView& scene, std::uint32_t kind_bits,
                                    std::size_t begin, std::size_t end, const RoundedRays& rays,
                                    const Occlusions& occlusions, const Pending& pending,
                                    TraceCounters& counters) {
        const RoundedRays some = from_ray(rays, begin);
        const Occlusions theirs{occlusions.t_most + begin, occlusions.state + begin};
        if (kind_bits != 0)
            TraceAll<Arch, Method>::occluded(scene, kind_bits, end - begin, some, theirs, counters);
        if (has_tree(pending))
            TraceTree<Arch, Method>::occluded(scene, end - begin, some, theirs, pending, counters);
    }

    static constexpr TraceKernels table() { return {nearest, occluded}; }
};

} // namespace raylane::simd
