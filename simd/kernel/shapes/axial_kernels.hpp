#pragma once

#include "simd/kernel/shapes/axial_certified_solver.hpp"
#include "simd/kernel/shapes/axial_filter.hpp"

#include <type_traits>

namespace raylane::simd {

/// ShapeKernels of a cylinder or cone, which differ in their solvers only.
template <bool tapers, bool capped, template <class, bool, bool> class SolverOf>
struct AxialKernels {
    template <class Arch>
    using Numbers = AxialNumbers<Arch, tapers>;
    template <class Arch>
    using Filter = AxialFilter<Arch, tapers, capped>;
    template <class Arch, bool textbook>
    using Solver = SolverOf<Arch, capped, textbook>;
    template <class D>
    using CertifiedSolver = std::conditional_t<capped, CappedCertifiedSolver<D, tapers>,
                                               OpenCertifiedSolver<D, tapers>>;
};

} // namespace raylane::simd
