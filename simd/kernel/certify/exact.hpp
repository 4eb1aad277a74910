#pragma once

#include "simd/kernel/shapes/shapes.hpp"
#include "simd/kernel/traverse/rays.hpp"

namespace raylane::simd {

/// Methods: how shapes are tested, one for each core::Precision. Each has
///   Rays       what a packet of rays is to its filters, at least FilterRays
///   certifies  whether its answers are the same however rays go together
///   rounded_alone  whether it asks nothing of rays but what they are in float
///   packet     the rays of a stream from one on, one per lane
///   broadcast  one of them in all lanes
///   with_filter(kind, visit)  calls visit.operator()<its filter for the kind>()
///
/// This one is core::Precision::exact: bounds in float, and what they leave in double.
template <class Arch>
struct ExactMethod : RaysInFloat<Arch> {
    static constexpr bool certifies = true;
    template <class Visit>
    static void with_filter(core::Kind kind, const Visit& visit) {
        simd::with_filter<Arch>(kind, visit);
    }
};

} // namespace raylane::simd
