#pragma once

#include "simd/kernel/shapes/axial_filter.hpp"
#include "simd/kernel/shapes/axial_finisher.hpp"

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
    using Finisher = std::conditional_t<capped, CappedFinisher<D, tapers>, OpenFinisher<D, tapers>>;
};

} // namespace raylane::simd
