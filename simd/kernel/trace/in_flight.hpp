#pragma once

#include "simd/kernel/trace/leaf.hpp"
#include "simd/kernel/trace/queue.hpp"

namespace raylane::simd {

/// Many rays at a time through the wide hierarchy, each by itself: while one waits for memory, or
/// for its own last result, others go on. In a round, all that are at nodes take a step, then all
/// that are at blocks; what would branch for each ray on its own sorts them into lists. This is
/// what TraceTree and TraceShadows share.
template <class Arch, class Method>
struct InFlight : Streams<Arch> {
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

    /// Calls visit.operator()<Filter>(ray, table) for those at blocks that may meet something
    /// there, those of a kind in turn.
    template <class Traveller, class Visit>
    static void for_each_at_block(const SceneView& scene, const RoundedRays& stream,
                                  const int* which, int count, Traveller* rays,
                                  const Visit& visit) {
        for (int k = 0; k < count;) {
            const KindNumber kind = kind_of(rays[which[k]].child);
            int end = k + 1;
            while (end < count && kind_of(rays[which[end]].child) == kind)
                ++end;
            Method::with_filter(kind, [&]<class Filter>() {
                for_each_of_kind<Filter>(stream, scene.tables[kind], which + k, end - k, rays,
                                         visit);
            });
            k = end;
        }
    }
    /// A function to itself: in one for all kinds, compilers run out of patience for inlining.
    template <class Filter, class Traveller, class Visit>
    [[gnu::noinline, gnu::flatten]] static void
    for_each_of_kind(const RoundedRays& stream, const TableView& table, const int* which, int count,
                     Traveller* rays, const Visit& visit) {
        int some[in_flight];
        if constexpr (has_may_meet<Filter, typename Method::Rays>) {
            int found = 0;
            for (int k = 0; k < count; ++k) {
                const Traveller& ray = rays[which[k]];
                some[found] = which[k];
                found += static_cast<int>(Leaf<Arch, Method>::template may_meet<Filter>(
                    S::block_of(table, ray.child & child_index), Method::broadcast(stream, ray.i)));
            }
            which = some;
            count = found;
        }
        for (int k = 0; k < count; ++k)
            visit.template operator()<Filter>(rays[which[k]], table);
    }
};

} // namespace raylane::simd
