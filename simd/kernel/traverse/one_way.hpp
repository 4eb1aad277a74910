#pragma once

#include "simd/kernel/traverse/every_shape/every_shape.hpp"
#include "simd/kernel/traverse/in_flight/nearest.hpp"
#include "simd/kernel/traverse/in_flight/occluded.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

/// Implements TraceKernels for the precisions that `exact` is compared with. It has one traversal
/// for each kind of scene, whatever the rays have in common. So there is less to compile, and the
/// answers of a float method do not depend on which rays are traced together.
template <class Arch, class Method>
struct OneWay {
    static void nearest(const SceneView& scene, std::uint32_t kind_bits, const Coherence*,
                        std::size_t count, const RoundedRays& rays, const Candidates& candidates,
                        const Workspace& workspace, TraceCounters& counters) {
        if (kind_bits != 0)
            EveryShape<Arch, Method>::nearest(scene, kind_bits, count, rays, candidates, counters);
        count_rays(count, workspace, counters);
        if (workspace.key != nullptr)
            InFlightNearest<Arch, Method>::nearest(scene, count, rays, candidates, workspace,
                                                   counters);
    }

    static void occluded(const SceneView& scene, std::uint32_t kind_bits, const Coherence*,
                         std::size_t count, const RoundedRays& rays, const Occlusions& occlusions,
                         const Workspace& workspace, TraceCounters& counters) {
        if (kind_bits != 0)
            EveryShape<Arch, Method>::occluded(scene, kind_bits, count, rays, occlusions, counters);
        count_rays(count, workspace, counters);
        if (workspace.key != nullptr)
            InFlightOccluded<Arch, Method>::occluded(scene, count, rays, occlusions, workspace,
                                                     counters);
    }

    static constexpr MethodKernels kernels() {
        return {{nearest, occluded}, Method::solve, Method::solve_all, {}, Method::nearest_of_few};
    }

  private:
    static void count_rays(std::size_t count, const Workspace& workspace, TraceCounters& counters) {
        (workspace.key == nullptr ? counters.one_by_one : counters.in_flight) += count;
    }
};

} // namespace raylane::simd
