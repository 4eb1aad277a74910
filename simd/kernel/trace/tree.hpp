#pragma once

#include "simd/kernel/trace/in_flight.hpp"

namespace raylane::simd {

/// The nearest hits of many rays in flight at a time.
template <class Arch, class Method>
struct TraceTree : InFlight<Arch, Method> {
    using S = Streams<Arch>;
    using Base = InFlight<Arch, Method>;
    using Lists = typename Base::Lists;
    using Base::kind_of, Base::fetch_ahead, Base::for_each_at_block;

    /// On its way to the nearest hit.
    struct Flight {
        Queue<Arch> queue;
        BoxRay box;
        BoxRay::Rows rows;
        std::uint32_t child; ///< to visit next
        std::size_t i;       ///< in the stream
        Best best;
        Pending pending;
        LeafHits hits;
    };

    /// All rays of a stream, from the root on.
    struct AllRays {
        const RoundedRays& rays;
        const Candidates& candidates;
        std::size_t count;
        std::size_t next = 0;
        BoxRays<Arch> box_rays{};

        /// Takes the next one, if there is any.
        bool start(Flight& flight) {
            if (next == count) return false;
            if (next % 16 == 0) box_rays.load(rays, next);
            flight.i = next;
            flight.child = 0;
            flight.box = box_rays.get(static_cast<int>(next % 16));
            flight.best = {candidates.first[next], candidates.second[next], candidates.slot[next]};
            ++next;
            return true;
        }
        void land(const Flight& flight) const {
            candidates.first[flight.i] = flight.best.first;
            candidates.second[flight.i] = flight.best.second;
            candidates.slot[flight.i] = flight.best.slot;
        }
    };

    static void nearest(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                        const Candidates& candidates, const Pending& pending,
                        TraceCounters& counters) {
        AllRays all{rays, candidates, count};
        Flight flights[in_flight];
        Lists lists;
        const std::size_t room = std::size_t{16} * (scene.tree_depth + 1);
        const auto set_out = [&](int which) {
            Flight& flight = flights[which];
            if (!all.start(flight)) return;
            flight.rows = flight.box.template rows<Arch>();
            flight.queue.clear();
            lists.sort(&which, 1, flights);
        };
        for (int which = 0; which < in_flight && static_cast<std::size_t>(which) < count; ++which) {
            const std::size_t from = room * static_cast<std::size_t>(which);
            flights[which].pending.t = pending.t + from;
            flights[which].pending.child = pending.child + from;
            set_out(which);
        }
        while (lists.node_count + lists.block_count != 0) {
            const int at_nodes = lists.node_count;
            for (int k = 0; k < at_nodes; ++k) {
                Flight& flight = flights[lists.at_nodes[k]];
                flight.child = flight.queue.step(scene.nodes[flight.child], flight.box, flight.rows,
                                                 flight.best.first, flight.pending);
                if (scene.large) fetch_ahead(scene, flight.child);
            }
            counters.nodes += static_cast<std::uint64_t>(at_nodes);
            lists.node_count = 0;
            lists.sort(lists.at_nodes, at_nodes, flights);

            const int at_blocks = lists.block_count;
            for (int k = 0; k < at_blocks; ++k)
                flights[lists.at_blocks[k]].hits.lanes = 0;
            for_each_at_block(
                scene, rays, lists.at_blocks, at_blocks, flights,
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
                all.land(flights[lists.done[k]]);
                set_out(lists.done[k]);
            }
        }
    }
};

} // namespace raylane::simd
