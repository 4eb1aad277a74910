#pragma once

#include "simd/kernel/certify/slot_reader.hpp"
#include "simd/kernel/certify/solve.hpp"
#include "simd/kernel/traverse/leaf.hpp"
#include "simd/kernel/traverse/traversal_queue.hpp"

namespace raylane::simd {

/// Lists all shapes that one ray may cross first. Implements RefineKernels::list_candidates.
template <class Arch, class Method>
struct ListCandidates : Streams<Arch> {
    using S = Streams<Arch>;
    using typename S::F;
    using typename S::M;

    static bool list(const SceneView& scene, std::uint32_t kind_bits, const RoundedRays& rays,
                     std::size_t i, const Pending& pending, CandidateList& list,
                     TraceCounters& counters) {
        bool has_room = true;
        S::for_each_kind(kind_bits, [&](core::Kind kind) {
            const std::uint32_t blocks = S::table_of(scene, kind).block_count;
            for (std::uint32_t block = 0; has_room && block < blocks; ++block)
                has_room = visit(scene, kind, block, rays, i, list, counters);
        });
        if (!has_room || pending.key == nullptr) return has_room;

        BoxRays<Arch> box_rays;
        box_rays.load(scene, rays, i / 16 * 16);
        const BoxRay ray = box_rays.get(static_cast<int>(i % 16));
        const BoxRay::Rows ray_rows = ray.template rows<Arch>();
        TraversalQueue<Arch> queue;
        queue.place(pending, 0, scene.tree_depth);
        queue.start(0);
        for (std::uint32_t child; (child = queue.pop(list.limit)) != no_child;) {
            if ((child & child_is_block) == 0) {
                ++counters.nodes;
                queue.enter(scene.nodes[child], ray, ray_rows, list.limit);
            } else if (!visit(scene, S::kind_of(child), child & child_index, rays, i, list,
                              counters)) {
                return false;
            }
        }
        return true;
    }

  private:
    /// The number of candidates below which sifting does not pay.
    static constexpr std::size_t few = 16;

    static bool visit(const SceneView& scene, core::Kind kind, std::uint32_t block,
                      const RoundedRays& rays, std::size_t i, CandidateList& list,
                      TraceCounters& counters) {
        bool has_room = true;
        counters.shapes += 16;
        Method::with_filter(kind, [&]<class Filter>() {
            has_room = add<Filter>(S::table_of(scene, kind), kind, block, rays, i, list);
        });
        return has_room;
    }

    template <class Filter>
    [[gnu::noinline]] static bool add(const TableView& table, core::Kind kind, std::uint32_t number,
                                      const RoundedRays& rays, std::size_t i, CandidateList& list) {
        BlockRoom<Arch> room;
        const float* block = S::template block_for<Filter>(table, number, room);
        const std::uint32_t* ids = S::ids_of(table, block);
        const typename Method::Rays ray = Method::broadcast(rays, i);
        for (int from = 0; from < 16; from += static_cast<int>(F::size)) {
            const Filter filter(BlockReader<Arch>(S::rows_of(block), from));
            const Bounds<Arch> bounds = filter.bounds(ray);
            const M possible =
                bounds.possible & Leaf<Arch, Method>::elsewhere(S::load_bits(ids + from), rays, i);
            const M counts = possible & (bounds.lower < F(list.limit));
            std::uint32_t bits = Lanes<Arch>::bits(counts);
            if (bits == 0) continue;
            const float last =
                Lanes<Arch>::least(select(counts & bounds.certain, bounds.upper, S::infinity()));
            const float limit = last * candidate_tolerance;
            list.limit = limit < list.limit ? limit : list.limit;
            if (list.sifts && list.count >= few) {
                with_certified_solver<Double<Arch>>(kind, [&]<class CertifiedSolver>() {
                    bits = sifted<CertifiedSolver>(table, number, from, rays, i, bits);
                });
            }
            float lower[F::size];
            bounds.lower.store_unaligned(lower);
            for (; bits != 0; bits &= bits - 1) {
                if (list.count == list.room) return false;
                const int lane = __builtin_ctz(bits);
                list.slot[list.count] =
                    table.first_slot + 16 * number + static_cast<std::uint32_t>(from + lane);
                list.lower[list.count++] = lower[lane];
            }
        }
        return true;
    }

    /// Returns the lanes in `bits` of a block, from `from` on, without those that the ray certainly
    /// misses.
    template <class CertifiedSolver>
    [[gnu::noinline]] static std::uint32_t sifted(const TableView& table, std::uint32_t number,
                                                  int from, const RoundedRays& rays, std::size_t i,
                                                  std::uint32_t bits) {
        using D = Double<Arch>;
        const auto in_all = [&](const double* const(&columns)[3]) {
            return Vectors<D>{Floats<D>(columns[0][i]), Floats<D>(columns[1][i]),
                              Floats<D>(columns[2][i])};
        };
        const Rays<D> ray = {in_all(rays.exact_origin), in_all(rays.exact_direction)};
        constexpr int width = static_cast<int>(Floats<D>::size);
        for (int half = 0; half < 2; ++half) {
            const std::uint32_t lanes = ((1U << width) - 1) << (half * width);
            if ((bits & lanes) == 0) continue;
            SlotReader<D> reader(table);
            for (int lane = 0; lane < width; ++lane)
                reader.set(static_cast<std::size_t>(lane),
                           table.first_slot + 16 * number +
                               static_cast<std::uint32_t>(from + half * width + lane));
            const CertifiedSolver solver{reader};
            const CertifiedCrossing<D> crossing =
                solver.template solve<Wanted::all>(ray, starts_nowhere<D>());
            bits &= ~(Lanes<D>::bits(crossing.misses & ~crossing.certain) << (half * width));
        }
        return bits;
    }
};

} // namespace raylane::simd
