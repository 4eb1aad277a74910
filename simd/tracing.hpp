#pragma once

#include "core/shapes/precision.hpp"
#include "simd/kernels.hpp"

#include <iterator>

namespace raylane::simd {

/// Kernels that trace rays: an instruction set's, and which of their methods.
struct Tracing {
    const Kernels* kernels;
    core::Precision precision = core::Precision::exact;

    const MethodKernels& method() const {
        static_assert(method_count == std::size(core::all_precisions));
        return kernels->methods[static_cast<std::size_t>(precision)];
    }
    /// True if candidates that cannot be told apart are left to who can.
    bool certifies() const { return !core::is_single(precision); }
};

/// A ray that has walked through so many surfaces, one search for each, is left to the reference,
/// which finds all that are still to come in one. Between surfaces that lie closer together than
/// numbers do, a walk would go round in circles: each step is lost in its origin, and what it has
/// passed is ahead of it again.
inline constexpr int longest_walk = 64;

} // namespace raylane::simd
