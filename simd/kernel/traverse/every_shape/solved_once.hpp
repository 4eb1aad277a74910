#pragma once

#include "simd/kernel/certify/slots.hpp"
#include "simd/kernel/traverse/every_shape/derived.hpp"

namespace raylane::simd {

/// Tests every shape against packets of rays, for float methods that certify nothing. Each crossing
/// is solved once, and the nearest stays in registers until it is the hit.
template <class Arch, bool textbook>
class SolvedOnce : Streams<Arch> {
  public:
    /// Implements MethodKernels::nearest_of_few.
    static void nearest(const SceneView& scene, std::uint32_t kind_bits, const Found& found,
                        const Candidates& candidates, TraceCounters& counters) {
        std::uint64_t shapes = 0;
        const Numbers derived(scene, kind_bits);
        for (std::size_t i = 0; i < found.count; i += F::size) {
            const Packet packet(found, i);
            Nearest nearest(candidates, i);
            S::for_each_kind(kind_bits, [&](core::Kind kind) {
                const TableView& table = S::table_of(scene, kind);
                with_solver<Arch, textbook>(kind, [&]<class Solver>() {
                    const auto test =
                        packet.leave_any ? test_all<Solver, true> : test_all<Solver, false>;
                    shapes += F::size * test(table, derived.of(kind), packet, nearest);
                });
            });
            nearest.store(candidates, found, i);
            solve(scene, derived, packet, nearest, found, i);
        }
        counters.shapes += shapes;
        counters.one_by_one += found.count;
    }

  private:
    using S = Streams<Arch>;
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    using V = Vectors<Arch>;

    struct WithSolver {
        template <class Visit>
        static void with(core::Kind kind, const Visit& visit) {
            with_solver<Arch, textbook>(kind, visit);
        }
    };
    using Numbers = DerivedNumbers<Arch, WithSolver>;
    using Rows = typename Numbers::Rows;

    struct Packet {
        MeasuredRays<Arch> rays;
        F origin_first, origin_last;
        bool leave_any; ///< some rays start on a shape

        Packet(const Found& found, std::size_t i)
            : rays(Rays<Arch>{narrow(found.origin, i), narrow(found.direction, i)}),
              origin_first(S::load_bits(found.origin_first + i)),
              origin_last(S::load_bits(found.origin_last + i)),
              leave_any(
                  Lanes<Arch>::bits(~Lanes<Arch>::in_range(origin_first, S::broadcast_bits(no_slot),
                                                           S::broadcast_bits(no_slot))) != 0) {}

        static V narrow(const double* const (&from)[3], std::size_t i) {
            return {Lanes<Arch>::narrow(from[0] + i), Lanes<Arch>::narrow(from[1] + i),
                    Lanes<Arch>::narrow(from[2] + i)};
        }
    };

    /// The nearest crossings of a packet so far.
    struct Nearest {
        F t, second, slot;
        F code = zero<Arch>(); ///< face, plus hit_entering if entering

        Nearest(const Candidates& candidates, std::size_t i)
            : t(S::load(candidates.first + i)), second(S::load(candidates.second + i)),
              slot(S::load_bits(candidates.slot + i)) {}

        [[gnu::always_inline]] void take(const Crossing<Arch>& crossing, std::uint32_t this_slot) {
            const F distance = select(crossing.exists, crossing.t, S::infinity());
            const M nearer = distance < t;
            second = min(second, max(distance, t));
            t = min(t, distance);
            slot = select(nearer, S::broadcast_bits(this_slot), slot);
            code = select(
                nearer,
                select(crossing.entering, crossing.face + F(float{hit_entering}), crossing.face),
                code);
        }

        F face() const {
            return select(code < F(float{hit_entering}), code, code - F(float{hit_entering}));
        }

        /// Stores candidates only if several have the same t, so that the caller can choose.
        void store(const Candidates& candidates, const Found& found, std::size_t i) const {
            if (Lanes<Arch>::bits((t == second) & (t < S::infinity())) != 0) [[unlikely]] {
                t.store_unaligned(candidates.first + i);
                second.store_unaligned(candidates.second + i);
            }
            S::store_bits(slot, candidates.slot + i);
            float codes[F::size];
            code.store_unaligned(codes);
            for (std::size_t lane = 0; lane < F::size; ++lane)
                found.hit[i + lane] =
                    static_cast<std::uint32_t>(static_cast<std::int32_t>(codes[lane]));
        }
    };

    /// Tests all shapes of a table. Returns how many there are.
    template <class Solver, bool leave_any>
    [[gnu::noinline, gnu::flatten]] static std::uint64_t
    test_all(const TableView& table, Rows derived, const Packet& of_packet, Nearest& of_nearest) {
        const Packet packet = of_packet;
        Nearest nearest = of_nearest;
        std::uint64_t count = 0;
        for (std::uint32_t b = 0; b < table.block_count; ++b) {
            const float* const block = S::block_of(table, b);
            const std::uint32_t* const ids = S::ids_of(table, block);
            const std::uint32_t slot = table.first_slot + 16 * b;
            for (std::uint32_t lane = 0; lane < 16 && ids[lane] != no_slot; ++lane, ++count) {
                const int place = static_cast<int>(lane);
                const auto test = [&](const Solver& solver) __attribute__((always_inline)) {
                    Crossing<Arch> crossing = first_ahead<Arch>(
                        solver.crossings(packet.rays, starts_nowhere<Arch>()), none<Arch>());
                    if constexpr (leave_any)
                        crossing.exists =
                            crossing.exists & ~Lanes<Arch>::in_range(S::broadcast_bits(ids[lane]),
                                                                     packet.origin_first,
                                                                     packet.origin_last);
                    nearest.take(crossing, slot + lane);
                };
                if constexpr (Derives<Arch, Solver>) {
                    if (derived != nullptr) {
                        test(Solver(Derived<BroadcastReader<Arch>>{{derived, place}}));
                        continue;
                    }
                }
                test(Solver(BroadcastReader<Arch>(S::rows_of(block), place)));
            }
        }
        of_nearest = nearest;
        return count;
    }

    /// Reads the floats of one shape per lane.
    struct Reader {
        const float* base;
        const std::uint32_t* places;

        F next() {
            const F values = Lanes<Arch>::gather(base, places);
            base += 16;
            return values;
        }
    };

    /// Stores t and normals, one kind after the other.
    static void solve(const SceneView& scene, const Numbers& derived, const Packet& packet,
                      const Nearest& nearest, const Found& found, std::size_t i) {
        const std::size_t rest = found.count - i;
        std::uint32_t left = ~in_range(nearest.slot, no_slot, no_slot) &
                             (rest < F::size ? (1U << rest) - 1 : all_lanes);
        if (left == 0) return;
        const V point = mul_add<Arch>(nearest.t, packet.rays.direction, packet.rays.origin);
        const F face = nearest.face();
        std::uint32_t slots[F::size];
        S::store_bits(nearest.slot, slots);
        store(nearest.t, found.t + i);
        store(zero<Arch>(), found.error + i);
        while (left != 0) {
            const core::Kind kind = Slots<Arch>::kind_of(scene, slots[__builtin_ctz(left)]);
            const TableView& table = S::table_of(scene, kind);
            const std::uint32_t first_slot = table.first_slot, count = 16 * table.block_count;
            const auto block_floats = static_cast<std::uint32_t>(table.block_floats);
            const std::uint32_t alike =
                left & in_range(nearest.slot, first_slot, first_slot + count - 1);
            std::uint32_t places[F::size]; // 32 bits suffice for a few shapes
            for (std::size_t lane = 0; lane < F::size; ++lane) {
                const std::uint32_t place = slots[lane] - first_slot;
                const std::uint32_t index = place < count ? place : 0;
                places[lane] = index / 16 * block_floats + index % 16;
            }
            with_solver<Arch, textbook>(kind, [&]<class Solver>() {
                if constexpr (Derives<Arch, Solver>) {
                    if (const Rows rows = derived.of(kind); rows != nullptr) {
                        const Derived<Reader> reader{{rows[0], places}};
                        return store_normals<Solver>(reader, point, face, found, i, alike);
                    }
                }
                store_normals<Solver>(Reader{table.blocks, places}, point, face, found, i, alike);
            });
            left &= ~alike;
        }
    }

    template <class Solver, class AnyReader>
    [[gnu::noinline, gnu::flatten]] static void
    store_normals(const AnyReader& reader, const V& point, const F& face, const Found& found,
                  std::size_t i, std::uint32_t lanes) {
        const Solver solver(reader);
        const V normal = solver.outward_normal(point, face);
        store(normal, found.normal, i, lanes);
        if (found.shading_normal[0] == nullptr) return;
        if constexpr (requires { solver.shading_normal(point, normal); })
            store(solver.shading_normal(point, normal), found.shading_normal, i, lanes);
        else
            store(normal, found.shading_normal, i, lanes);
    }

    static constexpr std::uint32_t all_lanes =
        static_cast<std::uint32_t>((std::uint64_t{1} << F::size) - 1);
    static std::uint32_t in_range(const F& slots, std::uint32_t first, std::uint32_t last) {
        return Lanes<Arch>::bits(
            Lanes<Arch>::in_range(slots, S::broadcast_bits(first), S::broadcast_bits(last)));
    }

    static void store(const V& values, double* const out[3], std::size_t i, std::uint32_t lanes) {
        store(values.x, out[0] + i, lanes);
        store(values.y, out[1] + i, lanes);
        store(values.z, out[2] + i, lanes);
    }
    static void store(const F& values, double* out, std::uint32_t lanes = all_lanes) {
        using D = Double<Arch>;
        constexpr std::size_t half = Floats<D>::size;
        for (int part = 0; part < 2; ++part) {
            double* const to = out + static_cast<std::size_t>(part) * half;
            const Floats<D> wide = Lanes<D>::widen(values, part);
            if (lanes == all_lanes)
                wide.store_unaligned(to);
            else
                select(Lanes<D>::from_bits(lanes >> (static_cast<unsigned>(part) * half) &
                                           ((1U << half) - 1)),
                       wide, Floats<D>::load_unaligned(to))
                    .store_unaligned(to);
        }
    }
};

} // namespace raylane::simd
