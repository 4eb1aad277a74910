#pragma once

#include "simd/kernel/certify/slots.hpp"
#include "simd/kernel/shapes/shapes.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

/// Reads the numbers of one shape into all lanes.
template <class Arch>
class OneShapeReader {
  public:
    explicit OneShapeReader(const Spots<Arch>& spots)
        : floats_(spots.base), doubles_(spots.doubles), next_(spots.offsets[0]) {}
    Floats<Double<Arch>> next() {
        const double value =
            doubles_ != nullptr ? doubles_[next_] : static_cast<double>(floats_[next_]);
        next_ += 16;
        return Floats<Double<Arch>>(value);
    }

  private:
    const float* floats_;
    const double* doubles_;
    long long next_;
};

/// Reads the numbers of one shape per lane.
template <class Arch>
class GatherReader {
  public:
    explicit GatherReader(const Spots<Arch>& spots) : spots_(spots) {}
    Floats<Double<Arch>> next() {
        using D = Double<Arch>;
        const int row = row_;
        row_ += 16;
        if (spots_.doubles == nullptr) [[likely]]
            return Lanes<D>::gather(spots_, row);
        double values[Floats<D>::size];
        for (std::size_t lane = 0; lane < Floats<D>::size; ++lane)
            values[lane] = spots_.doubles[spots_.offsets[lane] + row];
        return Floats<D>::load_unaligned(values);
    }

  private:
    const Spots<Arch>& spots_;
    int row_ = 0;
};

/// Implements MethodKernels::solve and solve_all.
template <class Arch, Wanted wanted>
class SolveCandidates {
  public:
    SolveCandidates(const SceneView& scene, const Found& found) : scene_(scene), found_(found) {}

    void all_rays() const {
        for (std::size_t i = 0; i < found_.count;) {
            std::uint32_t left = in_use(i) & ~in_range(found_.slot + i, no_slot, no_slot);
            std::size_t next = i + width;
            while (left != 0) {
                const core::Kind kind = S::kind_of(scene_, found_.slot[i + first_of(left)]);
                const TableView& table = S::table_of(scene_, kind);
                const std::uint32_t alike = left & in_table(table, i);
                with_certified_solver<Double<Arch>>(kind, [&]<class CertifiedSolver>() {
                    next = solve_run<CertifiedSolver>(table, i, alike);
                });
                left &= ~alike;
            }
            i = next;
        }
    }

  private:
    using D = Double<Arch>;
    using S = Slots<Arch>;
    using F = Floats<D>;
    using M = Mask<D>;
    static constexpr std::size_t width = F::size;
    static constexpr std::uint32_t all_lanes = (1U << width) - 1;

    static unsigned first_of(std::uint32_t lanes) {
        return static_cast<unsigned>(__builtin_ctz(lanes));
    }

    static std::uint32_t in_range(const std::uint32_t* values, std::uint32_t first,
                                  std::uint32_t last) {
        return Lanes<D>::bits(Lanes<D>::in_range(values, first, last));
    }

    std::uint32_t in_use(std::size_t i) const {
        const std::size_t rest = found_.count - i;
        return rest < width ? (1U << rest) - 1 : all_lanes;
    }

    std::uint32_t in_table(const TableView& table, std::size_t i) const {
        return in_range(found_.slot + i, table.first_slot,
                        table.first_slot + 16 * table.block_count - 1);
    }

    /// Solves the lanes `active` of packet i, all of which found shapes of one table. If these
    /// are all lanes, also solves the packets that follow, as long as this holds for them.
    /// Returns the ray at which the rest starts.
    template <class CertifiedSolver>
    [[gnu::noinline, gnu::flatten]] std::size_t solve_run(const TableView& table, std::size_t i,
                                                          std::uint32_t active) const {
        Spots<Arch> spots;
        float unpacked[PackedSpheres<Arch>::rows][16];
        spots.base = table.is_packed() ? unpacked[0] : table.blocks;
        spots.doubles = table.doubles;
        const auto place = [&](std::uint32_t slot, unsigned lane) -> long long {
            if (!table.is_packed()) [[likely]]
                return S::offset(table, slot);
            PackedSpheres<Arch>::unpack_one(table.packed, slot - table.first_slot, unpacked, lane);
            return lane;
        };
        while (true) {
            const std::uint32_t slot = found_.slot[i + first_of(active)];
            if (is_in(active, i, slot)) {
                // Values that depend on the shape alone are computed once for consecutive packets
                // of one shape.
                const long long only = place(slot, 0);
                for (long long& offset : spots.offsets)
                    offset = only;
                const CertifiedSolver solver{OneShapeReader<Arch>(spots)};
                do {
                    solve_packet(solver, table, spots, i, active);
                    i += width;
                } while (active == all_lanes && i + width <= found_.count &&
                         is_in(active, i, slot));
            } else {
                for (unsigned lane = 0; lane < width; ++lane)
                    spots.offsets[lane] =
                        place((active >> lane & 1) != 0 ? found_.slot[i + lane] : slot, lane);
                const CertifiedSolver solver{GatherReader<Arch>(spots)};
                solve_packet(solver, table, spots, i, active);
                i += width;
            }
            if (active != all_lanes || i + width > found_.count || in_table(table, i) != all_lanes)
                return i;
        }
    }

    /// True if all `active` lanes of packet i found the shape in `slot`.
    bool is_in(std::uint32_t active, std::size_t i, std::uint32_t slot) const {
        return (active & ~in_range(found_.slot + i, slot, slot)) == 0;
    }

    /// Solves one packet of solve_run.
    template <class CertifiedSolver>
    [[gnu::always_inline]] void solve_packet(const CertifiedSolver& solver, const TableView& table,
                                             const Spots<Arch>& spots, std::size_t i,
                                             std::uint32_t active) const {
        const Rays<D> rays = {load_vector(found_.origin, i), load_vector(found_.direction, i)};
        const bool leaves = leaves_any(i, active);
        const Starts<D> from = leaves ? starts(table, spots, i) : starts_nowhere<D>();
        CertifiedCrossing<D> crossing = solver.template solve<wanted>(rays, from);
        if constexpr (wanted == Wanted::all)
            if (leaves && !found_.holds_points) make_unit(crossing, from.on_surface);
        if (found_.holds_points)
            crossing.certain = crossing.certain & holds_point(rays, crossing.t, crossing.error);
        if (found_.start != nullptr) {
            const F start = load(found_.start + i); // its error is less than the factor below
            crossing.certain =
                crossing.certain & (crossing.t - crossing.error > start * F(1 + 0x1p-50));
        }
        store(crossing, i, active);
        if constexpr (requires { solver.shading_normal(rays.origin, rays.origin); }) {
            if (found_.shading_normal[0] != nullptr)
                store(solver.shading_normal(mul_add<D>(crossing.t, rays.direction, rays.origin),
                                            crossing.normal),
                      found_.shading_normal, i, active);
        } else if (found_.shading_normal[0] != nullptr) {
            store(crossing.normal, found_.shading_normal, i, active);
        }
    }

    /// Brings normals to unit length. Certified solvers take the origin of a ray that starts on the
    /// surface for a point of the surface, so that the normal there has the expected length. The
    /// origin of a caller's ray need not be such a point.
    static void make_unit(CertifiedCrossing<D>& crossing, const M& lanes) {
        const F inverse = select(lanes, F(1.0) / sqrt(squared_length(crossing.normal)), F(1.0));
        const Vectors<D>& error = crossing.normal_error;
        const F of_length = error.x + error.y + error.z;
        const auto with_length = [&](const F& of_component) {
            return select(lanes, (of_component + of_length) * inverse * F(1 + 0x1p-40) + F(0x1p-50),
                          of_component);
        };
        crossing.normal_error = {with_length(error.x), with_length(error.y), with_length(error.z)};
        crossing.normal = scaled<D>(inverse, crossing.normal);
    }

    bool leaves_any(std::size_t i, std::uint32_t active) const {
        const std::uint32_t no_shape = ~0U;
        return (active & ~in_range(found_.origin_first + i, no_shape, no_shape)) != 0;
    }

    Starts<D> starts(const TableView& table, const Spots<Arch>& spots, std::size_t i) const {
        const float* const ids = spots.base + 16 * static_cast<std::size_t>(table.values);
        Starts<D> starts;
        std::uint32_t id[width];
        for (unsigned lane = 0; lane < width; ++lane)
            id[lane] = __builtin_bit_cast(std::uint32_t, ids[spots.offsets[lane]]);
        starts.on_surface = Lanes<D>::in_range(id, found_.origin_first + i, found_.origin_last + i);
        starts.inward = Lanes<D>::from_numbers(found_.origin_bits + i, origin_inward) > zero<D>();
        starts.face = Lanes<D>::from_numbers(found_.origin_bits + i, origin_face);
        return starts;
    }

    [[gnu::always_inline]] static F load(const double* from) { return F::load_unaligned(from); }

    [[gnu::always_inline]] static Vectors<D> load_vector(const double* const from[3],
                                                         std::size_t i) {
        return {load(from[0] + i), load(from[1] + i), load(from[2] + i)};
    }

    [[gnu::always_inline]] void store(const CertifiedCrossing<D>& crossing, std::size_t i,
                                      std::uint32_t active) const {
        store(crossing.t, found_.t + i, active);
        store(crossing.error, found_.error + i, active);
        store(crossing.normal, found_.normal, i, active);
        F of_certain =
            crossing.face + select(crossing.entering, F(double{hit_entering}), zero<D>());
        if constexpr (wanted == Wanted::all)
            of_certain = of_certain +
                         select(is_rounded(crossing), zero<D>(), F(double{hit_normal_doubtful}));
        const F bits =
            select(crossing.certain, of_certain,
                   select(crossing.misses, F(double{hit_none}), F(double{hit_doubtful})));
        if (active == all_lanes) {
            Lanes<D>::to_numbers(found_.hit + i, bits);
            return;
        }
        std::uint32_t numbers[width];
        Lanes<D>::to_numbers(numbers, bits);
        for (unsigned lane = 0; lane < width; ++lane)
            if ((active >> lane & 1) != 0) found_.hit[i + lane] = numbers[lane];
    }

    [[gnu::always_inline]] static void store(const Vectors<D>& values, double* const out[3],
                                             std::size_t i, std::uint32_t active) {
        store(values.x, out[0] + i, active);
        store(values.y, out[1] + i, active);
        store(values.z, out[2] + i, active);
    }

    [[gnu::always_inline]] static void store(const F& values, double* out, std::uint32_t active) {
        if (active == all_lanes)
            values.store_unaligned(out);
        else
            select(Lanes<D>::from_bits(active), values, load(out)).store_unaligned(out);
    }

    const SceneView& scene_;
    const Found& found_;
};

template <class Arch, Wanted wanted>
void solve(const SceneView& scene, const Found& found) {
    SolveCandidates<Arch, wanted>(scene, found).all_rays();
}

} // namespace raylane::simd
