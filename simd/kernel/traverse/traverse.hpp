#pragma once

#include "simd/kernel/traverse/every_shape/every_shape.hpp"
#include "simd/kernel/traverse/frustum/packets.hpp"
#include "simd/kernel/traverse/frustum/sorted_by_direction.hpp"
#include "simd/kernel/traverse/frustum/walk.hpp"
#include "simd/kernel/traverse/in_flight/nearest.hpp"
#include "simd/kernel/traverse/in_flight/occluded.hpp"
#include "simd/kernel/traverse/list/nearest.hpp"
#include "simd/kernel/traverse/list/occluded.hpp"
#include "simd/kernel/traverse/single_rays.hpp"

namespace raylane::simd {

/// Implements TraceKernels and chooses the traversal: frusta for coherent rays; lists for rays that
/// are near each other, and for many that are not; interleaved single rays (in flight) for others;
/// and each shape in turn in scenes without a hierarchy.
template <class Arch, class Method>
struct Trace : Streams<Arch> {
    using Rays = Frustum<Arch>;
    template <bool nearest_first>
    using Walk = FrustumWalk<Arch, Method, nearest_first>;

    /// Rays may be traced by any traversal and in any order, as the answer for a ray depends on
    /// nothing but the ray in float.
    static_assert(Method::certifies && Method::rounded_alone);

    /// The number of shapes that a frustum of some rays may list before it gives up: for nearest
    /// hits, and to a light. With more shapes its rays are faster by another traversal.
    static int max_candidates(std::size_t rays) { return 64 + 2 * static_cast<int>(rays); }
    static int max_occluders(std::size_t rays) { return static_cast<int>(rays); }

    static bool makes_frusta(const Coherence* coherence) {
        return coherence != nullptr && !coherence->loose;
    }

    static void nearest(const SceneView& scene, std::uint32_t kind_bits, const Coherence* coherence,
                        std::size_t count, const RoundedRays& rays, const Candidates& candidates,
                        const Workspace& workspace, TraceCounters& counters) {
        if (!makes_frusta(coherence)) {
            nearest_of_any(scene, kind_bits, coherence, 0, count, rays, candidates, workspace,
                           counters);
            return;
        }
        for (std::size_t begin = 0; begin < count; begin += Rays::max_rays) {
            const std::size_t end = count - begin < Rays::max_rays ? count : begin + Rays::max_rays;
            Rays frustum;
            if (!frustum.enclose(rays, begin, end, *coherence, nullptr)) {
                nearest_of_any(scene, kind_bits, &neighbours, begin, end, rays, candidates,
                               workspace, counters);
                continue;
            }
            FrustumCandidates<Arch, Method> found(scene, rays, candidates, begin, end);
            if (!Walk<true>(scene, frustum, workspace, counters, max_candidates(end - begin))
                     .go(kind_bits, found)) {
                nearest_of_any(scene, kind_bits, &neighbours, begin, count, rays, candidates,
                               workspace, counters);
                return;
            }
            found.hand_back(candidates, begin, end);
            counters.in_frusta += end - begin;
        }
    }

    static void occluded(const SceneView& scene, std::uint32_t kind_bits,
                         const Coherence* coherence, std::size_t count, const RoundedRays& rays,
                         const Occlusions& occlusions, const Workspace& workspace,
                         TraceCounters& counters) {
        std::size_t done = 0;
        if (makes_frusta(coherence)) {
            if (coherence->converging && SortedByDirection<Arch>::has_room(count, workspace)) {
                const SortedByDirection<Arch> sorted(rays, occlusions, count, workspace);
                Workspace left = workspace;
                left.capacity = 0; // its memory holds the sorted rays
                done = occluded_frusta(scene, kind_bits, *coherence, count, sorted.rays,
                                       sorted.occlusions, left, counters);
                if (done != 0 && done != count)
                    occluded_of_any(scene, kind_bits, nullptr, done, count, sorted.rays,
                                    sorted.occlusions, left, counters);
                sorted.hand_back(occlusions, count);
                if (done != 0) return;
            } else {
                done = occluded_frusta(scene, kind_bits, *coherence, count, rays, occlusions,
                                       workspace, counters);
            }
            coherence = coherence->scattered ? nullptr : &neighbours;
        }
        if (done != count)
            occluded_of_any(scene, kind_bits, coherence, done, count, rays, occlusions, workspace,
                            counters);
    }

    /// Returns the number of rays that are done. If it is less than `count`, frusta of the rays
    /// that follow would usually list too many shapes.
    static std::size_t occluded_frusta(const SceneView& scene, std::uint32_t kind_bits,
                                       const Coherence& coherence, std::size_t count,
                                       const RoundedRays& rays, const Occlusions& occlusions,
                                       const Workspace& workspace, TraceCounters& counters) {
        for (std::size_t begin = 0; begin < count; begin += Rays::max_rays) {
            const std::size_t end = count - begin < Rays::max_rays ? count : begin + Rays::max_rays;
            Rays frustum;
            if (!frustum.enclose(rays, begin, end, coherence, occlusions.t_limit)) {
                occluded_of_any(scene, kind_bits, nullptr, begin, end, rays, occlusions, workspace,
                                counters);
                continue;
            }
            FrustumOcclusions<Arch, Method> found(scene, rays, occlusions, begin, end);
            const bool done =
                Walk<false>(scene, frustum, workspace, counters, max_occluders(end - begin))
                    .go(kind_bits, found);
            found.hand_back(occlusions, begin, end);
            if (!done) return begin;
            counters.in_frusta += end - begin;
        }
        return count;
    }

    /// Returns the streams from ray `begin` on.
    static RoundedRays from_ray(const RoundedRays& rays, std::size_t begin) {
        RoundedRays result = rays;
        for (int axis = 0; axis < 3; ++axis) {
            result.origin[axis] += begin;
            result.direction[axis] += begin;
            result.exact_origin[axis] += begin;
            result.exact_direction[axis] += begin;
        }
        result.slack += begin;
        result.origin_first += begin;
        result.origin_last += begin;
        return result;
    }

    /// True if random rays are traced by lists.
    static bool makes_lists(const SceneView& scene, std::size_t count) {
        return scene.small || (!scene.large && count >= long_list);
    }

    /// Traces rays that have only `coherence` in common, which is loose or null.
    static void nearest_of_any(const SceneView& scene, std::uint32_t kind_bits,
                               const Coherence* coherence, std::size_t begin, std::size_t end,
                               const RoundedRays& rays, const Candidates& candidates,
                               const Workspace& workspace, TraceCounters& counters) {
        const RoundedRays rounded = from_ray(rays, begin);
        const Candidates theirs{candidates.first + begin, candidates.second + begin,
                                candidates.slot + begin};
        const std::size_t count = end - begin;
        if (kind_bits != 0)
            EveryShape<Arch, Method>::nearest(scene, kind_bits, count, rounded, theirs, counters);
        if (workspace.key == nullptr) {
            counters.one_by_one += count;
        } else if (count <= SingleRays<Arch, Method>::most) {
            counters.in_flight += count;
            SingleRays<Arch, Method>::nearest(scene, count, rounded, theirs, workspace, counters);
        } else if ((coherence != nullptr || makes_lists(scene, count)) &&
                   count <= workspace.capacity) {
            counters.in_lists += count;
            ListNearest<Arch, Method>::nearest(scene, count, rounded, theirs, workspace, counters);
        } else {
            counters.in_flight += count;
            InFlightNearest<Arch, Method>::nearest(scene, count, rounded, theirs, workspace,
                                                   counters);
        }
    }

    static void occluded_of_any(const SceneView& scene, std::uint32_t kind_bits,
                                const Coherence* coherence, std::size_t begin, std::size_t end,
                                const RoundedRays& rays, const Occlusions& occlusions,
                                const Workspace& workspace, TraceCounters& counters) {
        const RoundedRays rounded = from_ray(rays, begin);
        const Occlusions theirs{occlusions.t_limit + begin, occlusions.state + begin};
        if (kind_bits != 0)
            EveryShape<Arch, Method>::occluded(scene, kind_bits, end - begin, rounded, theirs,
                                               counters);
        if (workspace.key == nullptr) {
            counters.one_by_one += end - begin;
        } else if (end - begin <= SingleRays<Arch, Method>::most) {
            counters.in_flight += end - begin;
            SingleRays<Arch, Method>::occluded(scene, end - begin, rounded, theirs, workspace,
                                               counters);
        } else if ((coherence != nullptr || scene.small) && end - begin <= workspace.capacity) {
            counters.in_lists += end - begin;
            ListOccluded<Arch, Method>::occluded(scene, end - begin, rounded, theirs, workspace,
                                                 counters);
        } else {
            counters.in_flight += end - begin;
            InFlightOccluded<Arch, Method>::occluded(scene, end - begin, rounded, theirs, workspace,
                                                     counters);
        }
    }

    static constexpr TraceKernels table() { return {nearest, occluded}; }
};

} // namespace raylane::simd
