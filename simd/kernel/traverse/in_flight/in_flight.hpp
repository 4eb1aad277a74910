#pragma once

#include "simd/kernel/traverse/pairs.hpp"
#include "simd/kernel/traverse/prefetch.hpp"

namespace raylane::simd {

/// Traces many single rays through the wide hierarchy, interleaved: while one waits for memory, or
/// for its last result, others proceed. In each round all rays take their next child. Then those at
/// nodes are tested against their boxes, and then those at blocks against their shapes. Rays are
/// sorted into lists where a single ray would branch.
template <class Arch, class Method>
struct InFlight : Streams<Arch> {
    using S = Streams<Arch>;

    /// A ray that is being traced.
    struct Traveller {
        BoxRay box;
        BoxRay::Rows rows;
        std::uint32_t child; ///< to visit next
        std::size_t i;       ///< index in the stream

        void set_out(const BoxRays<Arch>& rays, std::size_t number) {
            i = number;
            child = 0;
            box = rays.get(static_cast<int>(number % 16));
            rows = box.template rows<Arch>();
        }
    };

    /// Traces all rays that `travels` starts to their ends. `travels` has these functions:
    /// - start(traveller): makes it the next ray, at the root, and returns whether there is one
    /// - next(traveller): returns the child to visit, or no_child
    /// - at_node(traveller, node)
    /// - at_blocks(which, count): for the travellers that are at blocks
    /// - land(traveller)
    template <class Traveller, class Travels>
    [[gnu::always_inline]] static void go(const SceneView& scene, Traveller* travellers,
                                          Travels& travels, TraceCounters& counters) {
        int at_nodes[2 * in_flight], at_blocks[in_flight], done[in_flight];
        const Prefetcher<Arch> prefetcher(scene);
        int under_way = 0;
        while (under_way < in_flight && travels.start(travellers[under_way])) {
            at_nodes[under_way] = under_way;
            ++under_way;
        }
        int node_count = under_way, block_count = 0;
        while (under_way != 0) {
            for (int k = 0; k < node_count; ++k) {
                Traveller& traveller = travellers[at_nodes[k]];
                travels.at_node(traveller, scene.nodes[traveller.child]);
            }
            counters.nodes += static_cast<std::uint64_t>(node_count);
            travels.at_blocks(at_blocks, block_count);
            counters.shapes += 16 * static_cast<std::uint64_t>(block_count);

            for (int k = 0; k < block_count; ++k)
                at_nodes[node_count + k] = at_blocks[k];
            under_way = node_count + block_count;
            node_count = block_count = 0;
            int done_count = 0;
            for (int k = 0; k < under_way; ++k) {
                const int which = at_nodes[k];
                const std::uint32_t child = travels.next(travellers[which]);
                travellers[which].child = child;
                if (scene.large) prefetcher.fetch(child);
                at_nodes[node_count] = at_blocks[block_count] = done[done_count] = which;
                node_count += static_cast<int>((child & child_is_block) == 0);
                block_count += static_cast<int>((child & child_is_block) != 0 && child != no_child);
                done_count += static_cast<int>(child == no_child);
            }
            for (int k = 0; k < done_count; ++k) {
                travels.land(travellers[done[k]]);
                if (!travels.start(travellers[done[k]])) {
                    --under_way;
                    continue;
                }
                at_nodes[node_count++] = done[k];
            }
        }
    }

    /// Calls visit.template all<Filter>(traveller, table) for the travellers at blocks that may
    /// meet a shape there, one kind after the other. For filters that are costly and meet few
    /// shapes, it calls visit.template some<Filter>(pairs) instead, with the travellers' numbers.
    template <class Traveller, class Visit>
    static void for_each_at_block(const SceneView& scene, const RoundedRays& stream,
                                  const int* which, int count, Traveller* rays, Visit& visit) {
        int rest[in_flight] = {}, same[in_flight];
        for (int k = 0; k < count; ++k)
            rest[k] = which[k];
        while (count != 0) {
            const core::Kind kind = S::kind_of(rays[rest[0]].child);
            int same_count = 0, others = 0;
            for (int k = 0; k < count; ++k) {
                const int ray = rest[k];
                const bool is_same = S::kind_of(rays[ray].child) == kind;
                same[same_count] = rest[others] = ray;
                same_count += static_cast<int>(is_same);
                others += static_cast<int>(!is_same);
            }
            count = others;
            Method::with_filter(kind, [&]<class Filter>() {
                for_each_of_kind<Filter>(stream, S::table_of(scene, kind), same, same_count, rays,
                                         visit);
            });
        }
    }
    /// A separate function, as compilers reach their limits of inlining in one function for all
    /// kinds.
    template <class Filter, class Traveller, class Visit>
    [[gnu::noinline, gnu::flatten]] static void
    for_each_of_kind(const RoundedRays& stream, const TableView& table, const int* which, int count,
                     Traveller* rays, Visit& visit) {
        if constexpr (packs_pairs<Filter, Method>) {
            Pairs<Arch, Method> pairs;
            const auto take = [&] { visit.template some<Filter>(pairs); };
            for (int k = 0; k < count; ++k) {
                const Traveller& ray = rays[which[k]];
                BlockRoom<Arch> room;
                const std::uint32_t number = ray.child & child_index;
                pairs.template gather<Filter>(table, number,
                                              S::template block_for<Filter>(table, number, room),
                                              stream, ray.i, which[k], take);
            }
            pairs.flush(take);
        } else {
            for (int k = 0; k < count; ++k)
                S::template fetch_whole_rows<Filter>(table, rays[which[k]].child & child_index);
            int indices[in_flight], found = 0;
            for (int k = 0; k < count; ++k) {
                const Traveller& ray = rays[which[k]];
                indices[found] = which[k];
                const std::uint32_t number = ray.child & child_index;
                const auto may_meet = [&](const auto& block) {
                    return Leaf<Arch, Method>::template may_meet<Filter>(block, stream, ray.i);
                };
                if constexpr (has_may_meet<Filter, typename Method::Rays>)
                    found += static_cast<int>(
                        S::template with_lanes<Filter>(table, number, may_meet) != 0);
                else
                    found += static_cast<int>(
                        S::template with_ids<Filter>(table, number, may_meet) != 0);
            }
            for (int k = 0; k < found; ++k)
                visit.template all<Filter>(rays[indices[k]], table);
        }
    }
};

} // namespace raylane::simd
