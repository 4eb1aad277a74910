#pragma once

#include "simd/kernel/traverse/block_spheres.hpp"
#include "simd/kernel/traverse/every_shape/derived.hpp"
#include "simd/kernel/traverse/ray_lanes.hpp"

namespace raylane::simd {

/// Tests every shape against packets of rays, for scenes of a few shapes, and for unbounded shapes.
/// The rays stay in registers while the shapes are read one after the other.
template <class Arch, class Method>
struct EveryShape : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    /// Bounding spheres of the shapes whose filters cost most, so that packets which miss them need
    /// no further test. They are stored by block, in the order of the kinds. Blocks that do not fit
    /// have no spheres.
    struct Spheres {
        static constexpr int max_blocks = 12;
        BlockSpheres<Arch> around[max_blocks];
        int blocks = 0;

        Spheres(const SceneView& scene, std::uint32_t kind_bits) {
            S::for_each_kind(kind_bits, [&](core::Kind kind) {
                const TableView& table = S::table_of(scene, kind);
                Method::with_filter(kind, [&]<class Filter>() {
                    if constexpr (is_slow<Filter>)
                        for (std::uint32_t b = 0; b < table.block_count && blocks < max_blocks; ++b)
                            around[blocks++].enclose(kind, S::rows_of(S::block_of(table, b)));
                });
            });
        }

        /// True if a ray may meet the sphere before t_limit. The roundings are about 20 u of the
        /// distance, squared or not; `tolerance` is 32 u.
        bool may_meet(int block, int lane, const FilterRays<Arch>& rays, const F& t_limit) const {
            if (block >= blocks) return true;
            const F tolerance(32 * half_ulp), o = zero<Arch>();
            const SphereAround<Arch> sphere = around[block].broadcast(lane);
            const Vectors<Arch> to_center = sphere.center - rays.origin;
            const F tau = fast_dot(to_center, rays.direction);
            const F squared = fast_dot(to_center, to_center);
            const F radius = fast_mul_add<Arch>(
                tolerance, abs(tau), fast_mul_add<Arch>(F(4.0F), rays.slack, sphere.radius));
            // Values that overflow prove nothing.
            const M beside = (squared < S::infinity()) &
                             (squared - tau * tau - tolerance * squared > radius * radius);
            const M misses =
                beside | (tau + radius < o) | (tau - radius > t_limit * F(culling_slack));
            return Lanes<Arch>::bits(~misses) != 0;
        }
    };

    struct WithFilter {
        template <class Visit>
        static void with(core::Kind kind, const Visit& visit) {
            Method::with_filter(kind, visit);
        }
    };
    using Numbers = DerivedNumbers<Arch, WithFilter>;

    /// True if a filter is costly and has no may_meet(), the cheaper test that rejects rays before
    /// bounds() is called.
    template <class Filter>
    static constexpr bool is_slow = requires {
        Filter::is_costly;
    }
    &&!has_may_meet<Filter, typename Method::Rays>;

    using Packet = RayLanes<Arch, Method>;

    /// Data of the shapes that all packets need.
    struct Shapes {
        const SceneView& scene;
        Spheres spheres;
        Numbers derived;

        Shapes(const SceneView& view, std::uint32_t kind_bits)
            : scene(view), spheres(view, kind_bits), derived(view, kind_bits) {}
    };

    static const F& limit_of(const LaneCandidates<Arch>& found) { return found.first; }
    static const F& limit_of(const LaneOcclusions<Arch>& found) { return found.t_limit; }
    template <class Filter>
    [[gnu::always_inline]] static void test(LaneCandidates<Arch>& found, const Filter& filter,
                                            std::uint32_t id, std::uint32_t slot,
                                            const SceneView& scene, const Packet& packet) {
        found.test(filter, id, slot, cut_of<Method>(scene, slot), packet);
    }
    template <class Filter>
    [[gnu::always_inline]] static void test(LaneOcclusions<Arch>& found, const Filter& filter,
                                            std::uint32_t id, std::uint32_t slot,
                                            const SceneView& scene, const Packet& packet) {
        if (only_cuts<Arch, Method>(scene, slot)) return;
        found.test(filter, id, S::is_plain(scene, slot), cut_of<Method>(scene, slot), packet);
    }

    /// Tests a packet against all shapes of a kind that some of its rays may meet. A separate
    /// function, as only then do the packet's values stay in registers. Returns the number of these
    /// shapes. Counts the blocks that have spheres.
    template <class Filter, class Found>
    [[gnu::noinline, gnu::flatten]] static std::uint64_t
    test_kind(const Shapes& shapes, core::Kind kind, const Packet& of_packet, Found& of_found,
              int& sphere_block) {
        constexpr bool costly = is_slow<Filter>;
        const Packet packet = of_packet;
        Found found = of_found;
        const TableView& table = S::table_of(shapes.scene, kind);
        const typename Numbers::Rows rows = shapes.derived.of(kind);
        std::uint64_t count = 0;
        for (std::uint32_t b = 0; b < table.block_count; ++b) {
            const float* block = S::block_of(table, b);
            const std::uint32_t* ids = S::ids_of(table, block);
            for (int lane = 0; lane < 16 && ids[lane] != no_slot; ++lane) {
                if (costly &&
                    !shapes.spheres.may_meet(sphere_block, lane, packet.rays, limit_of(found)))
                    continue;
                ++count;
                const std::uint32_t slot =
                    table.first_slot + 16 * b + static_cast<std::uint32_t>(lane);
                if constexpr (Derives<Arch, Filter>) {
                    if (rows != nullptr) {
                        test(found, Filter(Derived<BroadcastReader<Arch>>{{rows, lane}}), ids[lane],
                             slot, shapes.scene, packet);
                        continue;
                    }
                }
                test(found, Filter(BroadcastReader<Arch>(S::rows_of(block), lane)), ids[lane], slot,
                     shapes.scene, packet);
            }
            if (costly) ++sphere_block;
        }
        of_found = found;
        return count;
    }

    template <class Found>
    static std::uint64_t test_all(const Shapes& shapes, std::uint32_t kind_bits,
                                  const Packet& packet, Found& found) {
        std::uint64_t count = 0;
        int sphere_block = 0;
        S::for_each_kind(kind_bits, [&](core::Kind kind) {
            Method::with_filter(kind, [&]<class Filter>() {
                count += test_kind<Filter>(shapes, kind, packet, found, sphere_block);
            });
        });
        return F::size * count;
    }

    static void nearest(const SceneView& scene, std::uint32_t kind_bits, std::size_t count,
                        const RoundedRays& stream, const Candidates& candidates,
                        TraceCounters& counters) {
        const Shapes shapes(scene, kind_bits);
        for (std::size_t i = 0; i < count; i += F::size) {
            const Packet packet(stream, i);
            LaneCandidates<Arch> found(candidates, i);
            counters.shapes += test_all(shapes, kind_bits, packet, found);
            found.store(candidates, i);
        }
    }

    static void occluded(const SceneView& scene, std::uint32_t kind_bits, std::size_t count,
                         const RoundedRays& stream, const Occlusions& occlusions,
                         TraceCounters& counters) {
        const Shapes shapes(scene, kind_bits);
        for (std::size_t i = 0; i < count; i += F::size) {
            const Packet packet(stream, i);
            LaneOcclusions<Arch> found(occlusions, i);
            counters.shapes += test_all(shapes, kind_bits, packet, found);
            found.store(occlusions.state + i, count - i);
        }
    }
};

} // namespace raylane::simd
