#pragma once

#include "simd/kernel/certify/slot_reader.hpp"
#include "simd/kernel/lanes/doubles.hpp"
#include "simd/kernel/shapes/shapes.hpp"
#include "simd/kernel/traverse/rays.hpp"
#include "simd/units/kernels.hpp"

#include <type_traits>

namespace raylane::simd {

/// Returns the crossing, which does not exist if its t overflows.
template <class Number>
Crossing<Number> at_finite_t(Crossing<Number> crossing) {
    crossing.exists = crossing.exists & (crossing.t < constant<Number>(__builtin_inff()));
    return crossing;
}

/// MethodKernels::solve by the solvers' formulas alone, in lanes of `Number`, which is an
/// instruction set or a Double<> of one. No result is doubtful.
template <class Number, bool textbook>
class PlainSolve {
  public:
    PlainSolve(const SceneView& scene, const Found& found) : scene_(scene), found_(found) {}

    void all_rays() const {
        for (std::size_t i = 0; i < found_.count; i += lanes) {
            const int filled =
                static_cast<int>(found_.count - i < lanes ? found_.count - i : lanes);
            std::uint32_t left = 0;
            for (int lane = 0; lane < filled; ++lane)
                left |= std::uint32_t{found_.slot[i + lane] != no_slot} << lane;
            while (left != 0) {
                const core::Kind kind = S::kind_of(scene_, found_.slot[i + __builtin_ctz(left)]);
                const TableView& table = S::table_of(scene_, kind);
                std::uint32_t alike = 0;
                for (int lane = 0; lane < filled; ++lane)
                    alike |= std::uint32_t{S::holds(table, found_.slot[i + lane])} << lane;
                alike &= left;
                with_solver<Number, textbook>(
                    kind, [&]<class Solver>() { solve_packet<Solver>(table, i, alike); });
                left &= ~alike;
            }
        }
    }

  private:
    using S = Slots<Number>;
    using F = Floats<Number>;
    using Value = typename F::value_type;
    static constexpr std::size_t lanes = F::size;
    static constexpr std::uint32_t all_lanes = (1U << lanes) - 1;

    struct Reader {
        SlotReader<Number> slots;
        bool one_shape = true; ///< all lanes have the same shape

        F next() { return one_shape ? slots.next_of(0) : slots.next(); }
    };

    /// Solves the lanes `active` from ray i on, all of which found shapes of one table.
    template <class Solver>
    void solve_packet(const TableView& table, std::size_t i, std::uint32_t active) const {
        const auto first_lane = static_cast<std::size_t>(__builtin_ctz(active));
        Reader reader{SlotReader<Number>(table)};
        std::uint32_t ids[lanes];
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::size_t ray = i + ((active >> lane & 1) != 0 ? lane : first_lane);
            ids[lane] = S::id(table, found_.slot[ray]);
            reader.slots.set(lane, found_.slot[ray]);
            reader.one_shape &= reader.slots.place[lane] == reader.slots.place[0];
        }
        const Starts<Number> starts = starts_of(ids, i);
        const Solver solver(reader);
        const Rays<Number> rays = {load_vector(found_.origin, i), load_vector(found_.direction, i)};
        const Crossing<Number> first =
            at_finite_t(first_ahead<Number>(solver.crossings(rays, starts), starts.on_surface));
        const Vectors<Number> point = mul_add<Number>(first.t, rays.direction, rays.origin);
        const Vectors<Number> normal = solver.outward_normal(point, first.face);

        const F bits =
            select(first.exists,
                   first.face + select(first.entering, F(Value(hit_entering)), zero<Number>()),
                   F(Value(hit_none)));
        Value numbers[lanes];
        bits.store_unaligned(numbers);
        for (std::size_t lane = 0; lane < lanes; ++lane)
            if ((active >> lane & 1) != 0)
                found_.hit[i + lane] = static_cast<std::uint32_t>(numbers[lane]);
        store(first.t, found_.t + i, active);
        store(zero<Number>(), found_.error + i, active);
        store(normal, found_.normal, i, active);
        if (found_.shading_normal[0] == nullptr) return;
        if constexpr (requires { solver.shading_normal(point, normal); })
            store(solver.shading_normal(point, normal), found_.shading_normal, i, active);
        else
            store(normal, found_.shading_normal, i, active);
    }

    Starts<Number> starts_of(const std::uint32_t (&ids)[lanes], std::size_t i) const {
        Value on_surface[lanes], inward[lanes], face[lanes];
        std::uint32_t any = 0;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::uint32_t first = found_.origin_first[i + lane];
            const bool on = ids[lane] - first <= found_.origin_last[i + lane] - first;
            any |= std::uint32_t{on};
            on_surface[lane] = on ? Value(1) : Value(0);
        }
        if (any == 0) return starts_nowhere<Number>();
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::uint32_t origins = found_.origin_bits[i + lane];
            inward[lane] = (origins & origin_inward) != 0 ? Value(1) : Value(0);
            face[lane] = static_cast<Value>(origins & origin_face);
        }
        return {F::load_unaligned(on_surface) > zero<Number>(),
                F::load_unaligned(inward) > zero<Number>(), F::load_unaligned(face)};
    }

    /// Load and store numbers in columns of doubles.
    static F load(const double* from) {
        if constexpr (std::is_same_v<Value, double>)
            return F::load_unaligned(from);
        else
            return Lanes<Number>::narrow(from);
    }
    static void store(const F& values, double* out, std::uint32_t active) {
        Value numbers[lanes];
        values.store_unaligned(numbers);
        if (active == all_lanes)
            for (std::size_t lane = 0; lane < lanes; ++lane)
                out[lane] = static_cast<double>(numbers[lane]);
        else
            for (std::size_t lane = 0; lane < lanes; ++lane)
                if ((active >> lane & 1) != 0) out[lane] = static_cast<double>(numbers[lane]);
    }

    static Vectors<Number> load_vector(const double* const from[3], std::size_t i) {
        return {load(from[0] + i), load(from[1] + i), load(from[2] + i)};
    }
    static void store(const Vectors<Number>& values, double* const out[3], std::size_t i,
                      std::uint32_t active) {
        store(values.x, out[0] + i, active);
        store(values.y, out[1] + i, active);
        store(values.z, out[2] + i, active);
    }

    const SceneView& scene_;
    const Found& found_;
};

} // namespace raylane::simd
