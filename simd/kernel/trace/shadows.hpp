#pragma once

#include "simd/kernel/trace/in_flight.hpp"

namespace raylane::simd {

/// Whether anything is in the way of many rays in flight at a time. One that is blocked is done.
template <class Arch, class Method>
struct TraceShadows : InFlight<Arch, Method> {
    using S = Streams<Arch>;
    using Base = InFlight<Arch, Method>;
    using Lists = typename Base::Lists;
    using Base::fetch_ahead, Base::for_each_at_block;
    using typename S::F;

    struct Shadow {
        BoxRay box;
        BoxRay::Rows rows;
        std::uint32_t child; ///< to visit next
        std::size_t i;       ///< in the stream
        float t_most;
        std::uint8_t state;
        std::uint32_t* bottom; ///< no_child
        std::uint32_t* top;    ///< behind the last of the children that are still to be visited

        void pop() {
            child = top[-1];
            --top;
        }
    };

    /// All rays of a stream that are not blocked, from the root on.
    struct AllRays {
        const RoundedRays& rays;
        const Occlusions& occlusions;
        std::size_t count;
        std::size_t next = 0, loaded = ~std::size_t{0};
        BoxRays<Arch> box_rays{};

        /// Takes the next one, if there is any.
        bool start(Shadow& shadow) {
            while (next < count && occlusions.state[next] == blocked)
                ++next;
            if (next >= count) return false;
            if (loaded != next / 16) {
                loaded = next / 16;
                box_rays.load(rays, 16 * loaded);
            }
            shadow.i = next;
            shadow.child = 0;
            shadow.box = box_rays.get(static_cast<int>(next % 16));
            shadow.t_most = occlusions.t_most[next];
            shadow.state = occlusions.state[next];
            ++next;
            return true;
        }
        void land(const Shadow& shadow) const { occlusions.state[shadow.i] = shadow.state; }
    };

    static void occluded(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                         const Occlusions& occlusions, const Pending& pending,
                         TraceCounters& counters) {
        AllRays all{rays, occlusions, count};
        Shadow shadows[in_flight];
        Lists lists;
        const std::size_t room = std::size_t{16} * (scene.tree_depth + 1);
        const auto set_out = [&](int which) {
            Shadow& shadow = shadows[which];
            if (!all.start(shadow)) return;
            shadow.rows = shadow.box.template rows<Arch>();
            shadow.top = shadow.bottom + 1;
            lists.sort(&which, 1, shadows);
        };
        for (int which = 0; which < in_flight && static_cast<std::size_t>(which) < count; ++which) {
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
                        shadow.box.template enter<Arch>(node, shadow.rows, from, t_most, near);
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
                scene, rays, lists.at_blocks, at_blocks, shadows,
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
                all.land(shadows[lists.done[k]]);
                set_out(lists.done[k]);
            }
        }
    }
};

} // namespace raylane::simd
