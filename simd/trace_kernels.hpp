#pragma once

#include "simd/scene_view.hpp"

#include <cstddef>
#include <cstdint>

/// Interface of the kernel units to the wavefront loop and to streams of rays: plain data only.
/// Arrays have `count` values and are readable and writable up to whole packets of 16; what is
/// behind `count` means nothing, before and after.
namespace raylane::simd {

struct Found;

/// Rays rounded to float (FilterRays in kernel/shapes/filter.hpp), with the shapes that they
/// leave, which no filter sees: ids first to last, no_shape twice if none.
struct RoundedRays {
    float* origin[3];
    float* direction[3];
    float* slack;
    const std::uint32_t* origin_first;
    const std::uint32_t* origin_last;
    const double* meant_origin[3]; ///< before they were rounded
    const double* meant_direction[3];
    /// How far along the rays meant these start: before that nothing is looked for, and from there
    /// their t counts. Null: they all start where they start.
    const double* before = nullptr;
};

/// Candidates for the nearest crossing of each ray. In and out.
struct Candidates {
    float* first;        ///< the smallest lower bound, infinity if there is none
    float* second;       ///< the next smallest of another shape
    std::uint32_t* slot; ///< the shape that has the smallest; no_slot if there is none
};

/// Number of random rays from which on they are better off as one list where the hierarchy is in
/// the cache.
inline constexpr std::size_t long_list = 4096;

/// A candidate's t is within this factor of its lower bound, or not certain to be the nearest:
/// what lies beyond has not been looked at.
inline constexpr float culling_slack = 1.0F + 0x1p-10F;

/// Occlusion of each ray before t_most.
struct Occlusions {
    const float* t_most;
    std::uint8_t* state; ///< in and out: Occlusion
};

/// Lanes that are blocked on the way in are not looked at.
enum Occlusion : std::uint8_t {
    unblocked = 0,
    doubtful = 1, ///< perhaps something, or something that light may pass
    blocked = 2,
};

/// Number of rays under way in the hierarchy at a time: their state fits in the first-level cache.
inline constexpr int in_flight = 32;

/// Room for what rays are still to visit in the hierarchy: for each of those in flight,
/// pending_entries(levels).
struct Pending {
    std::uint16_t* key; ///< null: there is no hierarchy to walk
    std::uint32_t* child;
};
/// 16 that are none, and then up to 30 a level: whichever of the last 16 is taken, its children
/// come behind the other 15. What is written at once may reach 20 beyond.
[[gnu::always_inline]] constexpr std::size_t pending_entries(std::uint32_t levels) {
    return std::size_t{16} * (2 * levels + 1);
}

/// Workspace of kernels: the above, and, if `capacity` is not 0, room for so many rays (less than
/// 65536) at a time that go together.
struct Workspace : Pending {
    std::size_t capacity;
    std::byte* records;   ///< list_record_bytes for each ray, aligned to 64
    std::uint16_t* lists; ///< list_entries(capacity, levels) ray numbers
};
inline constexpr std::size_t list_record_bytes = 64;
constexpr std::size_t list_entries(std::size_t rays, std::uint32_t levels) {
    return rays * (2 * std::size_t{levels} + 1) + 64;
}

struct CameraView {
    double from[3], forward[3], right[3], up[3]; ///< right and up are half a pixel long
    double lens_right[3], lens_up[3];            ///< unit
    double focus;                                ///< distance of the plane that is sharp
    bool orthographic;
};

struct TraceCounters {
    std::uint64_t nodes;  ///< visited by a ray, a list or a frustum
    std::uint64_t shapes; ///< tests of a ray against a shape
    std::uint64_t one_by_one, in_frusta, in_lists,
        in_flight; ///< rays, as EngineCounters has them
};

/// Rays that start at one point, or end there, or are parallel; or that would have come from one
/// point, as those that a flat mirror reflects. Consecutive ones are near each other, so that what
/// many of them miss need be found only once.
struct Coherence {
    float apex[3];   ///< unless they are parallel
    bool converging; ///< they end at the apex
    bool parallel;
    bool loose;          ///< they are near each other and no more: the rest means nothing
    bool beyond;         ///< they start beyond the apex
    float spread = 0.0F; ///< by which they miss the apex, at most
};
constexpr Coherence neighbours{{}, false, false, true, false};

/// Kernels for rays before and after they are traced.
struct RayKernels {
    /// Through points of the picture and, if there is a lens, of that: null if there is none.
    void (*camera_rays)(const CameraView& camera, std::size_t count, const double* across,
                        const double* upward, const double* lens_right, const double* lens_up,
                        double* const origin[3], double* const direction[3]);

    /// Fills origin, direction and slack, by the others. Rays are taken to be off by as much as
    /// shapes are whose floats are `rounding` away from them.
    void (*round_rays)(std::size_t count, const RoundedRays& rays, float rounding);

    /// Lists the lanes whose candidate is not certain to be the nearest, as none is before another
    /// nearer than `least`, and those that are `doubtful` anyway. What was found for the candidate
    /// is as in Found. Returns how many.
    std::size_t (*list_uncertain)(std::size_t count, const Candidates& candidates, const double* t,
                                  const double* error, const std::uint32_t* hit,
                                  const std::uint8_t* doubtful, float least, std::uint32_t* lanes);
};

/// The shapes of the kinds in `kind_bits` one by one, and the hierarchy if there is one to walk.
/// `coherence` is null if the rays have nothing in common, nor are near each other.
struct TraceKernels {
    void (*nearest)(const SceneView& scene, std::uint32_t kind_bits, const Coherence* coherence,
                    std::size_t count, const RoundedRays& rays, const Candidates& candidates,
                    const Workspace& workspace, TraceCounters& counters);
    void (*occluded)(const SceneView& scene, std::uint32_t kind_bits, const Coherence* coherence,
                     std::size_t count, const RoundedRays& rays, const Occlusions& occlusions,
                     const Workspace& workspace, TraceCounters& counters);
};

/// Candidates for a ray's first crossing, in no order.
struct CandidateList {
    std::uint32_t* slot;
    float* lower; ///< bounds
    std::size_t room, count;
    /// Limit, in and out: what lies beyond is not listed.
    float limit;
    /// True if RoundedRays has the ray as it is: of many, what it surely misses is not listed.
    bool sifts;
};

/// Factor between the limit of a list and the upper bound that it is taken from, so that what is
/// nearly as near is listed, too.
inline constexpr float candidate_grace = 1.0F + 0x1p-18F;

/// Crossings in twice the digits: t as the sum of two doubles, and what that may be off by.
struct WideCrossings {
    double *high, *low, *error;
    /// Outward normals of length 1, each component correctly rounded where `rounded` is 1: a bit
    /// for each of the three. Null if nobody asks.
    float* normal[3] = {};
    std::uint8_t* rounded = nullptr;
};

/// Pairs of a ray and a shape that it may cross. Those that there is no room for are only counted.
struct PairList {
    std::uint32_t *ray, *slot;
    std::size_t room, count;
};

/// Rays and shapes of which all crossings with t > 0 are asked, of rays that do not start on them.
struct CrossingPairs {
    std::size_t count;
    const double* origin[3]; ///< of rays, by ray
    const double* direction[3];
    const double* unit_direction[3]; ///< the same, brought to length 1
    const std::uint32_t* ray;        ///< of a pair; those of one ray are together
    const std::uint32_t* slot;

    /// Out: of pair k the crossings 2 k and 2 k + 1, in order. t is the sum of two doubles, and is
    /// off by at most the error.
    double *high, *low, *error;
    std::uint32_t* hit; ///< hit_none, hit_doubtful where little is known, or face and hit_entering
};

/// Kernels for rays that are left in doubt.
struct RefineKernels {
    /// Lists all that ray i may cross before the limit, in the kinds and the hierarchy as
    /// TraceKernels::nearest has them. Returns whether there was room.
    bool (*list_candidates)(const SceneView& scene, std::uint32_t kind_bits,
                            const RoundedRays& rays, std::size_t i, const Pending& pending,
                            CandidateList& list, TraceCounters& counters);
    /// MethodKernels::finish once more for lanes that it left doubtful. The others are left as they
    /// are.
    void (*finish_again)(const SceneView& scene, const Found& found);
    /// Widens `count` crossings that have been found, at some places of `found`, of the rays that
    /// are meant. The error is infinite, and no normal is rounded, where they are not known, as of
    /// rays that start on the shape.
    void (*widen)(const SceneView& scene, const Found& found, const std::size_t* places,
                  std::size_t count, const WideCrossings& wide);
    /// Adds all that rays may cross before t_most, each as TraceKernels::nearest has it, in any
    /// order; nothing of rays where that is not more than 0.
    void (*list_all)(const SceneView& scene, std::uint32_t kind_bits, std::size_t count,
                     const RoundedRays& rays, const float* t_most, const Pending& pending,
                     PairList& list);
    void (*cross_all)(const SceneView& scene, const CrossingPairs& pairs);
};

} // namespace raylane::simd
