#pragma once

#include "simd/kernel/certify/cross_all.hpp"
#include "simd/kernel/certify/finish.hpp"
#include "simd/kernel/certify/finish_again.hpp"
#include "simd/kernel/certify/list_candidates.hpp"
#include "simd/kernel/shapes/shapes.hpp"
#include "simd/kernel/traverse/in_flight/all.hpp"

namespace raylane::simd {

/// Methods: how shapes are tested, one for each core::Precision. Each has
///   Rays       what a packet of rays is to its filters, at least FilterRays
///   certifies  whether its answers are the same however rays go together
///   rounded_alone  whether it asks nothing of rays but what they are in float
///   packet     the rays of a stream from one on, one per lane
///   broadcast  one of them in all lanes
///   with_filter(kind, visit)  calls visit.operator()<its filter for the kind>()
///   finish, finish_all  of MethodKernels
///   refine     MethodKernels::refine
///
/// This one is core::Precision::exact: bounds in float, and what they leave in double.
template <class Arch>
struct ExactMethod : RaysInFloat<Arch> {
    static constexpr bool certifies = true;
    template <class Visit>
    static void with_filter(core::Kind kind, const Visit& visit) {
        simd::with_filter<Arch>(kind, visit);
    }
    static void finish(const SceneView& scene, const Found& found) {
        simd::finish<Arch, Wanted::crossings>(scene, found);
    }
    static void finish_all(const SceneView& scene, const Found& found) {
        simd::finish<Arch, Wanted::all>(scene, found);
    }
    static constexpr decltype(MethodKernels::nearest_of_few) nearest_of_few = nullptr;
    static constexpr RefineKernels refine() {
        return {ListCandidates<Arch, ExactMethod>::list, finish_again<Arch>, widen<Arch>,
                InFlightAll<Arch, ExactMethod>::list, cross_all<Arch>};
    }
};

} // namespace raylane::simd
