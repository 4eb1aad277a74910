#pragma once

#include "simd/kernel/traverse/leaf.hpp"
#include "simd/kernel/traverse/traversal_queue.hpp"

namespace raylane::simd {

/// Traces a few rays through the wide hierarchy, one after the other: without the lists and rounds
/// that other traversals need, which cost more than they gain for so few rays.
template <class Arch, class Method>
struct SingleRays : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;

    static constexpr std::size_t most = 4;

    static void nearest(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                        const Candidates& candidates, const Pending& pending,
                        TraceCounters& counters) {
        BoxRays<Arch> box_rays;
        box_rays.load(scene, rays, 0, count);
        TraversalQueue<Arch> queue;
        queue.place(pending, 0, scene.tree_depth);
        for (std::size_t i = 0; i < count; ++i) {
            const BoxRay box = box_rays.get(static_cast<int>(i));
            const BoxRay::Rows rows = box.template rows<Arch>();
            Best best = Leaf<Arch, Method>::best_of(candidates, i);
            queue.size = 0;
            for (std::uint32_t child = 0; child != no_child;) {
                if ((child & child_is_block) == 0) {
                    ++counters.nodes;
                    child = queue.enter_next(scene.nodes[child], box, rows, best.first);
                    continue;
                }
                counters.shapes += 16;
                Method::with_filter(S::kind_of(child), [&]<class Filter>() {
                    find<Filter>(scene, S::table_of(scene, S::kind_of(child)), child & child_index,
                                 rays, i, best);
                });
                child = queue.pop(best.first);
            }
            Leaf<Arch, Method>::store(best, candidates, i);
        }
    }

    static void occluded(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                         const Occlusions& occlusions, const Pending& pending,
                         TraceCounters& counters) {
        BoxRays<Arch> box_rays;
        box_rays.load(scene, rays, 0, count);
        std::uint32_t* const bottom = pending.child;
        *bottom = no_child;
        for (std::size_t i = 0; i < count; ++i) {
            std::uint8_t& state = occlusions.state[i];
            if (state == blocked) continue;
            const BoxRay box = box_rays.get(static_cast<int>(i));
            const BoxRay::Rows rows = box.template rows<Arch>();
            const float t_limit = occlusions.t_limit[i];
            std::uint32_t* top = bottom + 1; // one past the last child that is yet to be visited
            for (std::uint32_t child = 0; child != no_child; child = *--top) {
                if ((child & child_is_block) == 0) {
                    ++counters.nodes;
                    top = enter(scene.nodes[child], box, rows, t_limit, top);
                    continue;
                }
                counters.shapes += 16;
                std::uint8_t answer = unblocked;
                Method::with_filter(S::kind_of(child), [&]<class Filter>() {
                    answer = obstruct<Filter>(scene, S::table_of(scene, S::kind_of(child)),
                                              child & child_index, rays, i, t_limit);
                });
                state = answer > state ? answer : state;
                if (state == blocked) break;
            }
        }
    }

  private:
    /// Adds the children of a node that are entered before t_limit. Returns the new top.
    [[gnu::always_inline]] static std::uint32_t* enter(const NodeView& node, const BoxRay& box,
                                                       const BoxRay::Rows& rows, float t_limit,
                                                       std::uint32_t* top) {
        for (int from = 0, end = end_of_filled<Arch>(node.children); from < end;
             from += static_cast<int>(F::size)) {
            F near = zero<Arch>();
            const std::uint32_t bits = box.template enter<Arch>(node, rows, from, F(t_limit), near);
            Lanes<Arch>::compress_store(reinterpret_cast<float*>(top),
                                        S::load_bits(node.children + from), bits);
            top += __builtin_popcount(bits);
        }
        return top;
    }

    /// Tests a ray against a block. A separate function, as compilers reach their limits of
    /// inlining in one function for all kinds.
    template <class Filter>
    [[gnu::noinline, gnu::flatten]] static void find(const SceneView& scene, const TableView& table,
                                                     std::uint32_t number, const RoundedRays& rays,
                                                     std::size_t i, Best& best) {
        const std::uint32_t first_slot = table.first_slot + 16 * number;
        const ClipPlanesView* const cut = cut_of<Method>(scene, first_slot);
        S::template with_lanes<Filter>(table, number, [&](const auto& block) {
            if constexpr (has_may_meet<Filter, typename Method::Rays>)
                if (Leaf<Arch, Method>::template may_meet<Filter>(block, rays, i) == 0) return;
            LeafHits hits;
            Leaf<Arch, Method>::template find<Filter>(block, cut, rays, i, best.second, hits);
            Leaf<Arch, Method>::take(hits, first_slot, best);
        });
    }
    template <class Filter>
    [[gnu::noinline, gnu::flatten]] static std::uint8_t
    obstruct(const SceneView& scene, const TableView& table, std::uint32_t number,
             const RoundedRays& rays, std::size_t i, float t_limit) {
        return S::template with_lanes<Filter>(table, number, [&](const auto& block) {
            if constexpr (has_may_meet<Filter, typename Method::Rays>)
                if (Leaf<Arch, Method>::template may_meet<Filter>(block, rays, i) == 0)
                    return std::uint8_t{unblocked};
            return Leaf<Arch, Method>::template occluded<Filter>(scene, table, number, block, rays,
                                                                 i, t_limit);
        });
    }
};

} // namespace raylane::simd
