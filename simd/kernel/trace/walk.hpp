#pragma once

#include "simd/kernel/trace/group.hpp"
#include "simd/kernel/trace/places.hpp"
#include "simd/kernel/trace/queue.hpp"

namespace raylane::simd {

/// What the sixteen bunches of a group ask: the t from which on nothing matters to them.
struct GroupLimits {
    float t[16];
    float largest;
};

/// A group's way through the scene: a node or a block is visited once for all of its rays, and a
/// shape is tested against those bunches of 16 that may meet it. Nodes are visited in the order of
/// their distance; or, where that is of no use, what is below one before its neighbours.
template <class Arch, class Method, bool nearest_first>
struct GroupWalk : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using Rays = Group<Arch>;
    static constexpr std::size_t bunch = 16;

    const SceneView& scene;
    const Rays& group;
    const Workspace& workspace;
    TraceCounters& counters;
    /// Shapes that are still worth a look. Where the group is so wide that there are more, its rays
    /// are better off one by one.
    const int most_shapes;
    int budget = 0;
    GroupLimits limits;

    GroupWalk(const SceneView& scene_view, const Rays& rays, const Workspace& space,
              TraceCounters& trace_counters, int shapes)
        : scene(scene_view), group(rays), workspace(space), counters(trace_counters),
          most_shapes(shapes) {
        for (std::size_t which = 0; which < 16; ++which)
            limits.t[which] = which < group.bunches ? __builtin_inff() : -1.0F;
        update_limits();
    }

    void update_limits() {
        limits.largest = limits.t[0];
        for (int i = 1; i < 16; ++i)
            limits.largest = limits.t[i] > limits.largest ? limits.t[i] : limits.largest;
    }

    /// Calls visit(filter, id, slot, which) for each bunch, by number, that may meet a shape; it
    /// returns the t from which on nothing matters to the bunch. The shapes come in the order of
    /// their nodes' distances. Returns whether the budget was enough.
    template <class Visit>
    bool go(std::uint32_t kind_bits, const Visit& visit) {
        for (; kind_bits != 0; kind_bits &= kind_bits - 1) {
            const auto kind = static_cast<KindNumber>(__builtin_ctz(kind_bits));
            for (std::uint32_t block = 0; block < scene.tables[kind].block_count; ++block)
                at_block(kind, block, visit);
        }
        if (workspace.key == nullptr) return true;
        budget = most_shapes; // what is listed has to be tested whatever the way
        const Places<Arch> places(scene);
        Queue<Arch> queue;
        queue.place(workspace, 0, scene.tree_depth);
        queue.start(0);
        while (budget >= 0) {
            const std::uint32_t child =
                nearest_first ? queue.pop_before(limits.largest) : queue.pop_last();
            if (child == no_child || limits.largest < 0) return true;
            if ((child & child_is_block) != 0)
                at_block(S::kind_of(child), child & child_index, visit);
            else
                at_node(scene.nodes[child], queue, places);
        }
        return false;
    }

  private:
    void at_node(const NodeView& node, Queue<Arch>& queue, const Places<Arch>& places) {
        ++counters.nodes;
        for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
            F near = zero<Arch>();
            const std::uint32_t bits = group.enter(node, from, F(limits.largest), near);
            const int before = queue.size;
            queue.add(near, node.children + from, bits);
            if (!scene.large) continue;
            for (int k = before; k < queue.size; ++k)
                places.fetch(queue.child[k]);
        }
    }

    template <class Visit>
    void at_block(KindNumber kind, std::uint32_t number, const Visit& visit) {
        const TableView& table = scene.tables[kind];
        const float* block = S::block_of(table, number);
        const auto rows = S::rows_of(block);
        const std::uint32_t* ids = S::ids_of(table, block);
        BlockSpheres<Arch> spheres;
        spheres.enclose(kind, rows);
        std::uint32_t shapes = 0;
        for (int from = 0; from < 16; from += static_cast<int>(F::size))
            shapes |= group.meet(spheres, from) << from;
        if (shapes == 0) return;
        budget -= __builtin_popcount(shapes);
        bool changed = false;
        Method::with_filter(kind, [&]<class Filter>() {
            for (; shapes != 0; shapes &= shapes - 1) {
                const int lane = __builtin_ctz(shapes);
                std::uint32_t bunches = 0;
                for (std::size_t from = 0; from < 16; from += F::size)
                    bunches |=
                        group.bunches_that_meet(spheres, lane, from, S::load(limits.t + from))
                        << from;
                if (bunches == 0) continue;
                const Filter filter(BroadcastReader<Arch>(rows, lane));
                const std::uint32_t slot =
                    table.first_slot + 16 * number + static_cast<std::uint32_t>(lane);
                for (; bunches != 0; bunches &= bunches - 1) {
                    const int which = __builtin_ctz(bunches);
                    const float limit =
                        visit(filter, ids[lane], slot, static_cast<std::size_t>(which));
                    counters.shapes += bunch;
                    changed = changed || limit != limits.t[which];
                    limits.t[which] = limit;
                }
            }
        });
        if (changed) update_limits();
    }
};

} // namespace raylane::simd
