#pragma once

#include "simd/kernel/certify/plain_solve.hpp"
#include "simd/kernel/shapes/filter.hpp"
#include "simd/kernel/traverse/every_shape/solved_once.hpp"

namespace raylane::simd {

/// Filter that takes a solver's first crossing for certain.
template <class Arch, class Solver>
struct PlainFilter {
    static constexpr bool is_of_spheres = of_spheres<Solver>();
    static constexpr bool is_solver = true;
    Solver solver;

    template <class Reader>
    explicit PlainFilter(Reader reader) : solver(reader) {}

    [[gnu::always_inline]] Bounds<Arch> bounds(const FilterRays<Arch>& rays) const {
        const Crossing<Arch> first = first_ahead<Arch>(
            solver.crossings(Rays<Arch>{rays.origin, rays.direction}, starts_nowhere<Arch>()),
            none<Arch>());
        return {first.exists, first.t, first.exists, first.t};
    }
};

/// Method of core::Precision::robust or, if `textbook`, fast.
template <class Arch, bool textbook>
struct PlainMethod : RaysInFloat<Arch> {
    static constexpr bool certifies = false;
    template <class Visit>
    static void with_filter(core::Kind kind, const Visit& visit) {
        with_solver<Arch, textbook>(
            kind, [&]<class Solver>() { visit.template operator()<PlainFilter<Arch, Solver>>(); });
    }
    static void solve(const SceneView& scene, const Found& found) {
        PlainSolve<Arch, textbook>(scene, found).all_rays();
    }
    static void solve_all(const SceneView& scene, const Found& found) { solve(scene, found); }
    static constexpr auto nearest_of_few = SolvedOnce<Arch, textbook>::nearest;
};

} // namespace raylane::simd
