#pragma once

#include "simd/kernel/traverse/block_spheres.hpp"
#include "simd/kernel/traverse/ray_lanes.hpp"

namespace raylane::simd {

/// Every shape against packets of rays: for scenes of a few shapes, and for unbounded ones. The
/// rays stay in registers while the shapes go by.
template <class Arch, class Method>
struct EveryShape : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    /// Spheres around the shapes whose filters cost most, so that packets which pass them by need
    /// not be tested further. By block, in the order of the kinds; what has no room has no sphere.
    struct Spheres {
        static constexpr int most_blocks = 12;
        BlockSpheres<Arch> around[most_blocks];
        int blocks = 0;

        Spheres(const SceneView& scene, std::uint32_t kind_bits) {
            S::for_each_kind(kind_bits, [&](core::Kind kind) {
                const TableView& table = S::table_of(scene, kind);
                Method::with_filter(kind, [&]<class Filter>() {
                    if constexpr (is_slow<Filter>)
                        for (std::uint32_t b = 0; b < table.block_count && blocks < most_blocks;
                             ++b)
                            around[blocks++].enclose(kind, S::rows_of(S::block_of(table, b)));
                });
            });
        }

        /// True if a ray may meet the sphere before t_most. The roundings are some 20 u of the
        /// distance, squared or not; `grace` is 32 u.
        bool may_meet(int block, int lane, const FilterRays<Arch>& rays, const F& t_most) const {
            if (block >= blocks) return true;
            const F grace(32 * half_ulp), o = zero<Arch>();
            const SphereAround<Arch> sphere = around[block].broadcast(lane);
            const Vectors<Arch> to_center = sphere.center - rays.origin;
            const F tau = fast_dot(to_center, rays.direction);
            const F squared = fast_dot(to_center, to_center);
            const F radius = fast_mul_add<Arch>(
                grace, abs(tau), fast_mul_add<Arch>(F(4.0F), rays.slack, sphere.radius));
            // What overflows proves nothing.
            const M beside = (squared < S::infinity()) &
                             (squared - tau * tau - grace * squared > radius * radius);
            const M misses =
                beside | (tau + radius < o) | (tau - radius > t_most * F(culling_slack));
            return Lanes<Arch>::bits(~misses) != 0;
        }
    };

    /// True if a filter is costly, and cannot tell for less that there is nothing to meet.
    template <class Filter>
    static constexpr bool is_slow = requires {
        Filter::is_costly;
    }
    &&!has_may_meet<Filter, typename Method::Rays>;

    /// Calls visit(filter, id, slot) for each shape of the kinds that some of the rays may meet.
    /// `t_most` may change underway.
    template <class Visit>
    static void for_each_shape(const SceneView& scene, std::uint32_t kind_bits,
                               const Spheres& spheres, const FilterRays<Arch>& rays,
                               const F& t_most, const Visit& visit) {
        int sphere_block = 0;
        S::for_each_kind(kind_bits, [&](core::Kind kind) {
            const TableView& table = S::table_of(scene, kind);
            Method::with_filter(kind, [&]<class Filter>() {
                constexpr bool costly = is_slow<Filter>;
                for (std::uint32_t b = 0; b < table.block_count; ++b) {
                    const float* block = S::block_of(table, b);
                    const std::uint32_t* ids = S::ids_of(table, block);
                    for (int lane = 0; lane < 16 && ids[lane] != no_slot; ++lane) {
                        if (costly && !spheres.may_meet(sphere_block, lane, rays, t_most)) continue;
                        visit(Filter(BroadcastReader<Arch>(S::rows_of(block), lane)), ids[lane],
                              table.first_slot + 16 * b + static_cast<std::uint32_t>(lane));
                    }
                    if (costly) ++sphere_block;
                }
            });
        });
    }

    static void nearest(const SceneView& scene, std::uint32_t kind_bits, std::size_t count,
                        const RoundedRays& stream, const Candidates& candidates,
                        TraceCounters& counters) {
        const Spheres spheres(scene, kind_bits);
        std::uint64_t shapes = 0;
        for (std::size_t i = 0; i < count; i += F::size) {
            const RayLanes<Arch, Method> packet(stream, i);
            LaneCandidates<Arch> found(candidates, i);
            for_each_shape(scene, kind_bits, spheres, packet.rays, found.first,
                           [&](const auto& filter, std::uint32_t id, std::uint32_t slot) {
                               found.test(filter, id, slot, packet);
                               shapes += F::size;
                           });
            found.store(candidates, i);
        }
        counters.shapes += shapes;
    }

    static void occluded(const SceneView& scene, std::uint32_t kind_bits, std::size_t count,
                         const RoundedRays& stream, const Occlusions& occlusions,
                         TraceCounters& counters) {
        const Spheres spheres(scene, kind_bits);
        std::uint64_t shapes = 0;
        for (std::size_t i = 0; i < count; i += F::size) {
            const RayLanes<Arch, Method> packet(stream, i);
            LaneOcclusions<Arch> found(occlusions, i);
            for_each_shape(scene, kind_bits, spheres, packet.rays, found.t_most,
                           [&](const auto& filter, std::uint32_t id, std::uint32_t slot) {
                               found.test(filter, id, S::is_plain(scene, slot), packet);
                               shapes += F::size;
                           });
            found.store(occlusions.state + i, count - i);
        }
        counters.shapes += shapes;
    }
};

} // namespace raylane::simd
