#pragma once

#include "simd/kernel/traverse/frustum/frustum.hpp"
#include "simd/kernel/traverse/prefetch.hpp"
#include "simd/kernel/traverse/traversal_queue.hpp"

namespace raylane::simd {

/// A frustum's traversal of the scene. Each node or block is visited once for all rays. A shape is
/// tested against the packets of 16 rays that may meet it. Nodes are visited in the order of their
/// distance, or depth first if `nearest_first` is false.
template <class Arch, class Method, bool nearest_first>
struct FrustumWalk : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using Rays = Frustum<Arch>;

    const SceneView& scene;
    const Rays& frustum;
    const Workspace& workspace;
    TraceCounters& counters;
    /// The number of shapes that is still worth testing. If a frustum is so wide that it meets
    /// more, its rays are faster one by one.
    const int max_shapes;
    alignas(64) float limits[16]; ///< by packet: crossings beyond this t do not matter
    float largest_limit;

    FrustumWalk(const SceneView& scene_view, const Rays& rays, const Workspace& space,
                TraceCounters& trace_counters, int shapes)
        : scene(scene_view), frustum(rays), workspace(space), counters(trace_counters),
          max_shapes(shapes) {}

    /// Visits the shapes that packets may meet. For each of them it calls
    ///   found.test(filter, id, slot, which)  for each of these packets, by number, and sometimes
    ///   found.limit_of(which)                for the t beyond which crossings do not matter to it.
    /// Shapes come in the order of their nodes' distances, as far as these are known. Returns
    /// whether the budget sufficed.
    template <class Found>
    bool go(std::uint32_t kind_bits, Found& found) {
        for (float& limit : limits)
            limit = -1.0F; // for absent packets
        update_limits((1U << frustum.packets) - 1, found);
        S::for_each_kind(kind_bits, [&](core::Kind kind) {
            for (std::uint32_t block = 0; block < S::table_of(scene, kind).block_count; ++block) {
                const std::uint32_t child =
                    child_is_block | static_cast<std::uint32_t>(kind) << 27 | block;
                at_blocks(&child, 1, found);
            }
        });
        if (workspace.key == nullptr) return test_crossed(found);
        int budget = max_shapes; // shapes outside of the tree need a test by any traversal
        const Prefetcher<Arch> prefetcher(scene);
        TraversalQueue<Arch> queue;
        queue.place(workspace, 0, scene.tree_depth);
        queue.start(0);
        std::uint32_t blocks[batch];
        for (bool more = true; more && largest_limit >= 0;) {
            if (budget < 0) return false;
            int count = 0;
            while (count < batch) {
                const std::uint32_t child =
                    nearest_first ? queue.pop_before(largest_limit) : queue.pop_last();
                more = child != no_child;
                if (!more) break;
                if ((child & child_is_block) != 0)
                    blocks[count++] = child;
                else
                    at_node(scene.nodes[child], queue, prefetcher);
            }
            budget -= at_blocks(blocks, count, found);
        }
        return test_crossed(found);
    }

  private:
    /// Tests the faces whose tests were deferred. Returns whether there was room for all of them.
    template <class Found>
    bool test_crossed(Found& found) const {
        if constexpr (requires { found.crossed(); }) {
            const auto& crossed = found.crossed();
            for (int face = 0; face < crossed.count(); ++face)
                S::for_each_kind((1U << core::kind_count) - 1, [&](core::Kind kind) {
                    const TableView& table = S::table_of(scene, kind);
                    const std::uint32_t within = crossed.slot(face) - table.first_slot;
                    if (within / 16 >= table.block_count) return;
                    const auto lane = static_cast<int>(within % 16);
                    BlockRoom<Arch> room;
                    const float* block = S::block_of(table, within / 16, room);
                    Method::with_filter(kind, [&]<class Filter>() {
                        found.test_crossed(Filter(BroadcastReader<Arch>(S::rows_of(block), lane)),
                                           S::ids_of(table, block)[lane], face);
                    });
                });
            return crossed.has_room();
        }
        return true;
    }

    void at_node(const NodeView& node, TraversalQueue<Arch>& queue,
                 const Prefetcher<Arch>& prefetcher) {
        ++counters.nodes;
        for (int from = 0, end = end_of_filled<Arch>(node.children); from < end;
             from += static_cast<int>(F::size)) {
            F near = zero<Arch>();
            const std::uint32_t bits = frustum.enter(node, from, F(largest_limit), near);
            const int before = queue.size;
            queue.add(near, node.children + from, bits);
            if (!scene.large) continue;
            for (int k = before; k < queue.size; ++k)
                prefetcher.fetch(queue.child[k]);
        }
    }

    /// Lists all shapes that the frustum may meet, then all pairs of these and the packets that may
    /// meet them, and then tests the pairs. So dependent operations and branches occur once for
    /// several blocks. Returns the number of shapes.
    template <class Found>
    int at_blocks(const std::uint32_t* blocks, int block_count, Found& found) {
        BlockSpheres<Arch> spheres;
        BlockRoom<Arch> rooms[batch];
        const float* floats[batch];
        typename Rays::SeenBlock seen[batch];
        std::uint32_t shapes[16 * batch + F::size];
        int shape_count = 0;
        const float furthest = frustum.furthest_w(largest_limit);
        for (int b = 0; b < block_count; ++b) {
            const core::Kind kind = S::kind_of(blocks[b]);
            const TableView& table = S::table_of(scene, kind);
            if (table.is_packed()) {
                PackedSpheres<Arch>::unpack(table.packed, blocks[b] & child_index, rooms[b].rows);
                floats[b] = rooms[b].rows[0];
            } else {
                floats[b] = S::block_of(table, blocks[b] & child_index);
            }
            const int end = end_of_filled<Arch>(S::ids_of(table, floats[b]));
            spheres.enclose(kind, S::rows_of(floats[b]), end);
            for (int from = 0; from < end; from += static_cast<int>(F::size))
                shape_count +=
                    list(numbers + from, static_cast<std::uint32_t>(b) << 4,
                         frustum.meet(spheres, from, furthest, seen[b]), shapes + shape_count);
        }

        std::uint32_t pairs[16 * 16 * batch + F::size], meeting = 0;
        int count = 0;
        for (int k = 0; k < shape_count; ++k) {
            const int lane = static_cast<int>(shapes[k] & 15);
            for (std::size_t from = 0; from < 16; from += F::size) {
                const std::uint32_t packets = frustum.packets_that_meet(
                    seen[shapes[k] >> 4], lane, from, S::load(limits + from));
                count += list(numbers + from, shapes[k] << 4, packets, pairs + count);
                meeting |= packets << from;
            }
        }
        for (int tested = 0; tested < count;)
            tested = test_run(blocks, floats, pairs, tested, count, found);
        counters.shapes += 16 * static_cast<std::uint64_t>(count);
        update_limits(meeting, found);
        return shape_count;
    }

    template <class Found>
    void update_limits(std::uint32_t of_packets, const Found& found) {
        for (; of_packets != 0; of_packets &= of_packets - 1) {
            const int which = __builtin_ctz(of_packets);
            limits[which] = found.limit_of(static_cast<std::size_t>(which));
        }
        largest_limit = S::greatest_of_16(limits);
    }

    /// Tests pairs from `begin` on while their shapes are of one kind. Returns the end of these
    /// pairs.
    template <class Found>
    int test_run(const std::uint32_t* blocks, const float* const* floats,
                 const std::uint32_t* pairs, int begin, int count, Found& found) {
        const core::Kind kind = S::kind_of(blocks[pairs[begin] >> 8]);
        int end = begin;
        Method::with_filter(kind, [&]<class Filter>() {
            while (end < count) {
                const std::uint32_t shape = pairs[end] >> 4, child = blocks[shape >> 4];
                if (S::kind_of(child) != kind) break;
                const TableView& table = S::table_of(scene, kind);
                const std::uint32_t number = child & child_index, lane = shape & 15;
                const float* block = floats[shape >> 4];
                const Filter filter(
                    BroadcastReader<Arch>(S::rows_of(block), static_cast<int>(lane)));
                do
                    found.test(filter, S::ids_of(table, block)[lane],
                               table.first_slot + 16 * number + lane, pairs[end++] & 15);
                while (!is_cheap<Filter> && end < count && pairs[end] >> 4 == shape);
            }
        });
        return end;
    }

    /// True if constructing a filter again is faster than checking whether it would be the same.
    template <class Filter>
    static constexpr bool is_cheap =
        Method::certifies&& Method::rounded_alone && !sifts_packets<Filter, typename Method::Rays>;

    /// Writes the wanted ones of a register's worth of numbers, with `above` in their higher bits.
    /// Returns how many these are.
    static int list(const std::uint32_t* entries, std::uint32_t above, std::uint32_t wanted,
                    std::uint32_t* to) {
        Lanes<Arch>::compress_store(reinterpret_cast<float*>(to),
                                    S::load_bits(entries) | S::broadcast_bits(above), wanted);
        return __builtin_popcount(wanted);
    }

    /// The number of blocks that are processed together.
    static constexpr int batch = 4;
    static constexpr std::uint32_t numbers[] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                8, 9, 10, 11, 12, 13, 14, 15};
};

} // namespace raylane::simd
