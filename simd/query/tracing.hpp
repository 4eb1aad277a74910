#pragma once

#include "core/shapes/precision.hpp"
#include "simd/units/kernels.hpp"

#include <iterator>

namespace raylane::simd {

/// Kernels that trace rays: those of one instruction set, and the precision that selects their
/// method.
struct Tracing {
    const Kernels* kernels;
    core::Precision precision = core::Precision::exact;

    const MethodKernels& method() const {
        static_assert(method_count == std::size(core::all_precisions));
        return kernels->methods[static_cast<std::size_t>(precision)];
    }
    /// Returns true if candidates that cannot be distinguished are passed on to a more precise
    /// stage.
    bool certifies() const { return !core::is_single(precision); }
};

/// A ray that has walked through this many surfaces, with one search for each, is left to the
/// reference tracer, which finds all further ones in one search. Between surfaces that are closer
/// together than adjacent numbers, a walk would never end: each step is lost in the rounding of its
/// origin, and surfaces that it has passed are ahead of it again.
inline constexpr int longest_walk = 64;

} // namespace raylane::simd
