#pragma once

#include "simd/kernel/certify/plain.hpp"

namespace raylane::simd {

/// Rays before rounding, in halves of a packet.
template <class Arch>
struct DoubleRays : FilterRays<Arch> {
    Rays<Double<Arch>> halves[2];
};

/// Filter that returns a solver's first crossing in double.
template <class Arch, class Solver>
struct DoubleFilter {
    using D = Double<Arch>;
    static constexpr bool is_of_spheres = of_spheres<Solver>();
    static constexpr bool is_solver = true;
    Solver halves[2];

    template <class Reader>
    explicit DoubleFilter(Reader reader)
        : halves{Solver(HalfReader<Arch, Reader>(reader, 0)),
                 Solver(HalfReader<Arch, Reader>(reader, 1))} {}

    [[gnu::always_inline]] Bounds<Arch> bounds(const DoubleRays<Arch>& rays) const {
        double t[Floats<Arch>::size], exist[Floats<Arch>::size];
        for (int half = 0; half < 2; ++half) {
            const Crossing<D> first = at_finite_t(first_ahead<D>(
                halves[half].crossings(rays.halves[half], starts_nowhere<D>()), none<D>()));
            const int from = half * static_cast<int>(Floats<D>::size);
            first.t.store_unaligned(t + from);
            select(first.exists, Floats<D>(1.0), zero<D>()).store_unaligned(exist + from);
        }
        const Mask<Arch> exists = Lanes<Arch>::narrow(exist) > zero<Arch>();
        const Floats<Arch> rounded = min(Lanes<Arch>::narrow(t), Floats<Arch>(__FLT_MAX__));
        return {exists, rounded * Floats<Arch>(1 - 0x1p-23F), exists,
                rounded * Floats<Arch>(1 + 0x1p-22F)};
    }
};

/// Method of core::Precision::plain_double. The filters' bounds are only as wide as float, in which
/// candidates are stored, requires. Candidates that float cannot separate are left for the caller
/// to compare in double.
template <class Arch>
struct DoubleMethod {
    using D = Double<Arch>;
    using Rays = DoubleRays<Arch>;
    static constexpr bool rounded_alone = false;
    static constexpr bool certifies = true;

    static Rays packet(const RoundedRays& rays, std::size_t i) {
        Rays result{RaysInFloat<Arch>::packet(rays, i), {}};
        for (int half = 0; half < 2; ++half) {
            const std::size_t from = i + static_cast<std::size_t>(half) * Floats<D>::size;
            result.halves[half] = {load(rays.exact_origin, from), load(rays.exact_direction, from)};
        }
        return result;
    }
    static Rays broadcast(const RoundedRays& rays, std::size_t i) {
        const auto in_all = [&](const double* const(&from)[3]) {
            return Vectors<D>{Floats<D>(from[0][i]), Floats<D>(from[1][i]), Floats<D>(from[2][i])};
        };
        const simd::Rays<D> ray = {in_all(rays.exact_origin), in_all(rays.exact_direction)};
        return {RaysInFloat<Arch>::broadcast(rays, i), {ray, ray}};
    }
    template <class Visit>
    static void with_filter(core::Kind kind, const Visit& visit) {
        with_solver<D>(
            kind, [&]<class Solver>() { visit.template operator()<DoubleFilter<Arch, Solver>>(); });
    }
    static void solve(const SceneView& scene, const Found& found) {
        PlainSolve<D, false>(scene, found).all_rays();
    }
    static void solve_all(const SceneView& scene, const Found& found) { solve(scene, found); }
    static constexpr decltype(MethodKernels::nearest_of_few) nearest_of_few = nullptr;

  private:
    static Vectors<D> load(const double* const (&from)[3], std::size_t i) {
        return {Floats<D>::load_unaligned(from[0] + i), Floats<D>::load_unaligned(from[1] + i),
                Floats<D>::load_unaligned(from[2] + i)};
    }
};

} // namespace raylane::simd
