#pragma once

#include "simd/kernel/trace/rays.hpp"

namespace raylane::simd {

/// One ray at a time through the wide hierarchy: 16 boxes or 16 shapes at once.
///
/// The boxes' planes are shifted by the slack of the origin, away from the box; a quotient is then
/// off by 3 u and the direction by u more, relative to itself, which `allowance` grants.
template <class Arch>
struct TraceTree : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    static constexpr float allowance = 1 + 16 * half_ulp;

    /// What is the same for all boxes.
    struct BoxRay {
        F near_origin[3], far_origin[3], inverse[3];
        bool falls[3];

        BoxRay(const RoundedRays& rays, std::size_t i) {
            for (int axis = 0; axis < 3; ++axis) {
                // A component of 0 is as good as one that leads nowhere: no 0 * infinity then.
                constexpr float tiny = 0x1p-100F;
                const float component = rays.direction[axis][i], o = rays.origin[axis][i];
                const float d = component > tiny || component < -tiny ? component : tiny;
                falls[axis] = d < 0.0F;
                const float slack = 2 * rays.slack[i];
                inverse[axis] = F(1.0F / d);
                near_origin[axis] = F(falls[axis] ? o - slack : o + slack);
                far_origin[axis] = F(falls[axis] ? o + slack : o - slack);
            }
        }

        /// The boxes that are entered before t_most, as bits, and where.
        std::uint32_t enter(const NodeView& node, int from, const F& t_most, F& near) const {
            near = zero<Arch>();
            F far = t_most;
            for (int axis = 0; axis < 3; ++axis) {
                const float* lower = node.lower[axis] + from;
                const float* upper = node.upper[axis] + from;
                const F at_near =
                    (S::load(falls[axis] ? upper : lower) - near_origin[axis]) * inverse[axis];
                const F at_far =
                    (S::load(falls[axis] ? lower : upper) - far_origin[axis]) * inverse[axis];
                near = xsimd::max(at_near, near);
                far = xsimd::min(at_far, far);
            }
            return Lanes<Arch>::bits(near <= far * F(allowance)) & S::filled(node, from);
        }
    };

    struct Best {
        float first, second;
        std::uint32_t slot;
    };

    /// The shapes of a block that the ray does not leave.
    static M elsewhere(const std::uint32_t* ids, const RoundedRays& rays, std::size_t i) {
        return ~Lanes<Arch>::in_range(S::load_bits(ids), S::broadcast_bits(rays.departed_first[i]),
                                      S::broadcast_bits(rays.departed_last[i]));
    }

    static void nearest_in_block(const SceneView& scene, std::uint32_t child,
                                 const FilterRays<Arch>& ray, const RoundedRays& rays,
                                 std::size_t i, Best& best) {
        const auto kind = static_cast<KindNumber>(child >> 27 & 0xF);
        const TableView& table = scene.tables[kind];
        const float* block = S::block_of(table, child & child_index);
        const std::uint32_t* ids = S::ids_of(table, block);
        with_filter<Arch>(kind, [&]<class Filter>() {
            for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
                const Filter filter(BlockReader<Arch>(S::rows_of(block), from));
                const Bounds<Arch> bounds = filter.bounds(ray);
                const M counts = bounds.possible & elsewhere(ids + from, rays, i) &
                                 (bounds.lower < F(best.second));
                std::uint32_t bits = Lanes<Arch>::bits(counts);
                if (bits == 0) continue;
                float lower[F::size];
                bounds.lower.store_unaligned(lower);
                for (; bits != 0; bits &= bits - 1) {
                    const int lane = __builtin_ctz(bits);
                    const float t = lower[lane];
                    if (t < best.first) {
                        best.second = best.first;
                        best.first = t;
                        best.slot = table.first_slot + 16 * (child & child_index) +
                                    static_cast<std::uint32_t>(from + lane);
                    } else if (t < best.second) {
                        best.second = t;
                    }
                }
            }
        });
    }

    static void nearest(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                        const Candidates& candidates, const Pending& pending,
                        TraceCounters& counters) {
        for (std::size_t i = 0; i < count; ++i) {
            const BoxRay box_ray(rays, i);
            const FilterRays<Arch> ray = S::broadcast(rays, i);
            Best best{candidates.first[i], candidates.second[i], candidates.slot[i]};
            int size = 0;
            std::uint32_t child = 0; // the root
            for (;;) {
                if ((child & child_is_block) != 0) {
                    nearest_in_block(scene, child, ray, rays, i, best);
                    counters.shapes += 16;
                } else {
                    ++counters.nodes;
                    const int before = size;
                    const NodeView& node = scene.nodes[child];
                    const F t_most(best.first * culling_slack);
                    for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
                        F near = zero<Arch>();
                        std::uint32_t bits = box_ray.enter(node, from, t_most, near);
                        float near_t[F::size];
                        near.store_unaligned(near_t);
                        for (; bits != 0; bits &= bits - 1) {
                            const int slot = __builtin_ctz(bits);
                            const float t = near_t[slot];
                            int place = size++;
                            for (; place > before && pending.t[place - 1] < t; --place) {
                                pending.t[place] = pending.t[place - 1];
                                pending.child[place] = pending.child[place - 1];
                            }
                            pending.t[place] = t;
                            pending.child[place] = node.children[from + slot];
                        }
                    }
                }
                const float t_most = best.first * culling_slack * allowance;
                while (size > 0 && pending.t[size - 1] > t_most)
                    --size;
                if (size == 0) break;
                child = pending.child[--size];
            }
            candidates.first[i] = best.first;
            candidates.second[i] = best.second;
            candidates.slot[i] = best.slot;
        }
    }

    static std::uint8_t occluded_in_block(const SceneView& scene, std::uint32_t child,
                                          const FilterRays<Arch>& ray, const RoundedRays& rays,
                                          std::size_t i, float t_most) {
        const auto kind = static_cast<KindNumber>(child >> 27 & 0xF);
        const TableView& table = scene.tables[kind];
        const std::uint32_t number = child & child_index;
        const float* block = S::block_of(table, number);
        const std::uint32_t* ids = S::ids_of(table, block);
        const std::uint32_t plain = scene.plain_lanes == nullptr
                                        ? 0xFFFF
                                        : scene.plain_lanes[table.first_slot / 16 + number];
        std::uint8_t state = open;
        with_filter<Arch>(kind, [&]<class Filter>() {
            for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
                const Filter filter(BlockReader<Arch>(S::rows_of(block), from));
                const Bounds<Arch> bounds = filter.bounds(ray);
                const M possible = bounds.possible & elsewhere(ids + from, rays, i) &
                                   (bounds.lower < F(t_most * (1 + 4 * half_ulp)));
                if (Lanes<Arch>::bits(possible) == 0) continue;
                const M certain =
                    possible & bounds.certain & (bounds.upper < F(t_most * (1 - 4 * half_ulp)));
                if ((Lanes<Arch>::bits(certain) & plain >> from) != 0) {
                    state = blocked;
                    return;
                }
                state = doubtful;
            }
        });
        return state;
    }

    static void occluded(const SceneView& scene, std::size_t count, const RoundedRays& rays,
                         const Occlusions& occlusions, const Pending& pending,
                         TraceCounters& counters) {
        for (std::size_t i = 0; i < count; ++i) {
            if (occlusions.state[i] == blocked) continue;
            const BoxRay box_ray(rays, i);
            const FilterRays<Arch> ray = S::broadcast(rays, i);
            const F t_most(occlusions.t_most[i]);
            int size = 0;
            std::uint32_t child = 0;
            for (;;) {
                if ((child & child_is_block) != 0) {
                    counters.shapes += 16;
                    const std::uint8_t state =
                        occluded_in_block(scene, child, ray, rays, i, occlusions.t_most[i]);
                    if (state > occlusions.state[i]) occlusions.state[i] = state;
                    if (state == blocked) break;
                } else {
                    ++counters.nodes;
                    const NodeView& node = scene.nodes[child];
                    for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
                        F near = zero<Arch>();
                        std::uint32_t bits = box_ray.enter(node, from, t_most, near);
                        for (; bits != 0; bits &= bits - 1)
                            pending.child[size++] = node.children[from + __builtin_ctz(bits)];
                    }
                }
                if (size == 0) break;
                child = pending.child[--size];
            }
        }
    }
};

} // namespace raylane::simd
