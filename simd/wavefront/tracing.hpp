#pragma once

#include "core/precision.hpp"
#include "simd/kernels.hpp"

#include <iterator>

namespace raylane::simd {

/// What traces rays: an instruction set's kernels, and which of their methods.
struct Tracing {
    const Kernels* kernels;
    core::Precision precision = core::Precision::exact;

    const MethodKernels& method() const {
        static_assert(method_count == std::size(core::all_precisions));
        return kernels->methods[static_cast<std::size_t>(precision)];
    }
    /// Whether candidates that cannot be told apart are left to who can.
    bool certifies() const { return !core::is_single(precision); }
};

} // namespace raylane::simd
