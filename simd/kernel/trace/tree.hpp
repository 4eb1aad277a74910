#pragma once

#include "simd/kernel/trace/leaf.hpp"
#include "simd/kernel/trace/queue.hpp"

namespace raylane::simd {

/// Many rays at a time through the wide hierarchy, each by itself: while one waits for memory, or
/// for its own last result, others go on. In a round, all that are at nodes take a step, then all
/// that are at blocks; what would branch for each ray on its own sorts them into lists.
template <class Arch, class Method>
struct TraceTree : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    /// The rays that are at nodes and at blocks, and those that are done.
    struct Lists {
        int at_nodes[in_flight], at_blocks[in_flight], done[in_flight];
        int node_count = 0, block_count = 0, done_count = 0;

        /// Where each of `count` rays is to go.
        template <class Traveller>
        void sort(const int* which, int count, const Traveller* rays) {
            for (int k = 0; k < count; ++k) {
                const int ray = which[k];
                const std::uint32_t child = rays[ray].child;
                at_nodes[node_count] = at_blocks[block_count] = done[done_count] = ray;
                node_count += static_cast<int>((child & child_is_block) == 0);
                block_count += static_cast<int>((child & child_is_block) != 0 && child != no_child);
                done_count += static_cast<int>(child == no_child);
            }
        }
    };

    static KindNumber kind_of(std::uint32_t child) {
        return static_cast<KindNumber>(child >> 27 & 0xF);
    }

    static void fetch_ahead(const SceneView& scene, std::uint32_t child) {
        if (child == no_child) return;
        const char* from = reinterpret_cast<const char*>(scene.nodes + child);
        std::size_t bytes = sizeof(NodeView);
        if ((child & child_is_block) != 0) {
            const TableView& table = scene.tables[kind_of(child)];
            from = reinterpret_cast<const char*>(S::block_of(table, child & child_index));
            bytes = table.block_floats * sizeof(float);
        }
        for (std::size_t at = 0; at < bytes; at += 64)
            __builtin_prefetch(from + at);
    }

    /// Calls visit.operator()<Filter>(ray, table) for those at blocks, those of a kind in turn.
    template <class Traveller, class Visit>
    static void for_each_at_block(const SceneView& scene, const int* which, int count,
                                  Traveller* rays, const Visit& visit) {
        for (int k = 0; k < count;) {
            const KindNumber kind = kind_of(rays[which[k]].child);
            int end = k + 1;
            while (end < count && kind_of(rays[which[end]].child) == kind)
                ++end;
            Method::with_filter(kind, [&]<class Filter>() {
                for_each_of_kind<Filter>(scene.tables[kind], which + k, end - k, rays, visit);
            });
            k = end;
        }
    }
    /// A function to itself: in one for all kinds, compilers run out of patience for inlining.
    template <class Filter, class Traveller, class Visit>
    [[gnu::noinline, gnu::flatten]] static void
    for_each_of_kind(const TableView& table, const int* which, int count, Traveller* rays,
                     const Visit& visit) {
        for (int k = 0; k < count; ++k)
            visit.template operator()<Filter>(rays[which[k]], table);
    }

    struct Flight {
        Queue<Arch> queue;
        BoxRay ray;
        std::uint32_t child; ///< to visit next
        std::size_t i;       ///< in the stream
        Best best;
        Pending pending;
        LeafHits hits;
    };

    static void nearest(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                        const Candidates& candidates, const Pending& pending,
                        TraceCounters& counters) {
        Flight flights[in_flight];
        BoxRays<Arch> box_rays;
        Lists lists;
        std::size_t next = 0;
        const std::size_t room = std::size_t{16} * (scene.tree_depth + 1);
        const auto set_out = [&](int which) {
            if (next == count) return;
            if (next % 16 == 0) box_rays.load(rays, next);
            Flight& flight = flights[which];
            flight.i = next;
            flight.child = 0;
            flight.ray = box_rays.get(static_cast<int>(next % 16));
            flight.queue.clear();
            flight.best = {candidates.first[next], candidates.second[next], candidates.slot[next]};
            ++next;
            lists.at_nodes[lists.node_count++] = which;
        };
        for (int which = 0; which < in_flight; ++which) {
            const std::size_t from = room * static_cast<std::size_t>(which);
            flights[which].pending = {pending.t + from, pending.child + from};
            set_out(which);
        }
        while (lists.node_count + lists.block_count != 0) {
            const int at_nodes = lists.node_count;
            for (int k = 0; k < at_nodes; ++k) {
                Flight& flight = flights[lists.at_nodes[k]];
                flight.child = flight.queue.step(scene.nodes[flight.child], flight.ray,
                                                 flight.best.first, flight.pending);
                if (scene.large) fetch_ahead(scene, flight.child);
            }
            counters.nodes += static_cast<std::uint64_t>(at_nodes);
            lists.node_count = 0;
            lists.sort(lists.at_nodes, at_nodes, flights);

            const int at_blocks = lists.block_count;
            for_each_at_block(
                scene, lists.at_blocks, at_blocks, flights,
                [&]<class Filter>(Flight & flight, const TableView& table)
                    __attribute__((always_inline)) {
                        Leaf<Arch, Method>::template find<Filter>(table, flight.child & child_index,
                                                                  rays, flight.i,
                                                                  flight.best.second, flight.hits);
                    });
            int hit[in_flight], hit_count = 0;
            for (int k = 0; k < at_blocks; ++k) {
                hit[hit_count] = lists.at_blocks[k];
                hit_count += static_cast<int>(flights[lists.at_blocks[k]].hits.lanes != 0);
            }
            for (int k = 0; k < hit_count; ++k) {
                Flight& flight = flights[hit[k]];
                const TableView& table = scene.tables[kind_of(flight.child)];
                Leaf<Arch, Method>::take(
                    flight.hits, table.first_slot + 16 * (flight.child & child_index), flight.best);
            }
            for (int k = 0; k < at_blocks; ++k) {
                Flight& flight = flights[lists.at_blocks[k]];
                flight.child = flight.queue.pop(flight.best.first, flight.pending);
                if (scene.large) fetch_ahead(scene, flight.child);
            }
            counters.shapes += 16 * static_cast<std::uint64_t>(at_blocks);
            lists.block_count = 0;
            lists.sort(lists.at_blocks, at_blocks, flights);

            const int done = lists.done_count;
            lists.done_count = 0;
            for (int k = 0; k < done; ++k) {
                const Flight& flight = flights[lists.done[k]];
                candidates.first[flight.i] = flight.best.first;
                candidates.second[flight.i] = flight.best.second;
                candidates.slot[flight.i] = flight.best.slot;
                set_out(lists.done[k]);
            }
        }
    }

    struct Shadow {
        BoxRay ray;
        std::uint32_t child;
        std::size_t i;
        float t_most;
        std::uint8_t state;
        std::uint32_t* bottom; ///< no_child
        std::uint32_t* top;    ///< behind the last of the children that are still to be visited

        void pop() {
            child = top[-1];
            --top;
        }
    };

    static void occluded(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                         const Occlusions& occlusions, const Pending& pending,
                         TraceCounters& counters) {
        Shadow shadows[in_flight];
        BoxRays<Arch> box_rays;
        Lists lists;
        std::size_t next = 0, loaded = ~std::size_t{0};
        const std::size_t room = std::size_t{16} * (scene.tree_depth + 1);
        const auto set_out = [&](int which) {
            while (next < count && occlusions.state[next] == blocked)
                ++next;
            if (next >= count) return;
            if (loaded != next / 16) {
                loaded = next / 16;
                box_rays.load(rays, 16 * loaded);
            }
            Shadow& shadow = shadows[which];
            shadow.i = next;
            shadow.child = 0;
            shadow.ray = box_rays.get(static_cast<int>(next % 16));
            shadow.t_most = occlusions.t_most[next];
            shadow.state = occlusions.state[next];
            shadow.top = shadow.bottom + 1;
            ++next;
            lists.at_nodes[lists.node_count++] = which;
        };
        for (int which = 0; which < in_flight; ++which) {
            shadows[which].bottom = pending.child + room * static_cast<std::size_t>(which);
            *shadows[which].bottom = no_child;
            set_out(which);
        }
        while (lists.node_count + lists.block_count != 0) {
            const int at_nodes = lists.node_count;
            for (int k = 0; k < at_nodes; ++k) {
                Shadow& shadow = shadows[lists.at_nodes[k]];
                const NodeView& node = scene.nodes[shadow.child];
                const F t_most(shadow.t_most);
                for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
                    F near = zero<Arch>();
                    const std::uint32_t bits =
                        shadow.ray.template enter<Arch>(node, from, t_most, near);
                    Lanes<Arch>::compress_store(reinterpret_cast<float*>(shadow.top),
                                                S::load_bits(node.children + from), bits);
                    shadow.top += __builtin_popcount(bits);
                }
                shadow.pop();
                if (scene.large) fetch_ahead(scene, shadow.child);
            }
            counters.nodes += static_cast<std::uint64_t>(at_nodes);
            lists.node_count = 0;
            lists.sort(lists.at_nodes, at_nodes, shadows);

            const int at_blocks = lists.block_count;
            for_each_at_block(
                scene, lists.at_blocks, at_blocks, shadows,
                [&]<class Filter>(Shadow & shadow,
                                  const TableView& table) __attribute__((always_inline)) {
                    const std::uint8_t state = Leaf<Arch, Method>::template occluded<Filter>(
                        scene, table, shadow.child & child_index, rays, shadow.i, shadow.t_most);
                    shadow.state = state > shadow.state ? state : shadow.state;
                    shadow.top = state == blocked ? shadow.bottom + 1 : shadow.top;
                });
            for (int k = 0; k < at_blocks; ++k) {
                Shadow& shadow = shadows[lists.at_blocks[k]];
                shadow.pop();
                if (scene.large) fetch_ahead(scene, shadow.child);
            }
            counters.shapes += 16 * static_cast<std::uint64_t>(at_blocks);
            lists.block_count = 0;
            lists.sort(lists.at_blocks, at_blocks, shadows);

            const int done = lists.done_count;
            lists.done_count = 0;
            for (int k = 0; k < done; ++k) {
                const Shadow& shadow = shadows[lists.done[k]];
                occlusions.state[shadow.i] = shadow.state;
                set_out(lists.done[k]);
            }
        }
    }
};

} // namespace raylane::simd
