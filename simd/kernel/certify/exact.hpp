#pragma once

#include "simd/kernel/shapes/shapes.hpp"
#include "simd/kernel/traverse/rays.hpp"

namespace raylane::simd {

/// A method defines how shapes are tested. There is one for each core::Precision. Each has
///   Rays           a packet of rays as its filters need them, at least FilterRays
///   certifies      whether its answers do not depend on how rays are grouped
///   rounded_alone  whether it needs the rays in float only
///   packet         returns the rays of a stream from i on, one per lane
///   broadcast      returns ray i in all lanes
///   with_filter(kind, visit)  calls visit.operator()<its filter for the kind>()
///
/// This method is core::Precision::exact: bounds in float, and double for the shapes that they do
/// not reject.
template <class Arch>
struct ExactMethod : RaysInFloat<Arch> {
    static constexpr bool certifies = true;
    template <class Visit>
    static void with_filter(core::Kind kind, const Visit& visit) {
        simd::with_filter<Arch>(kind, visit);
    }
};

} // namespace raylane::simd
