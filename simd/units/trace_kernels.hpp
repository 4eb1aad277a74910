#pragma once

#include "simd/units/scene_view.hpp"

#include <cstddef>
#include <cstdint>

/// Interface of the kernel units to the wavefront loop and to streams of rays: plain data only.
/// Arrays have `count` values and are readable and writable up to whole packets of 16. Values
/// beyond `count` are meaningless, before and after.
namespace raylane::simd {

struct Found;

/// The part of a ray's slack that covers roundings of slack itself (FilterRays in
/// kernel/shapes/filter.hpp).
inline constexpr float slack_floor = 0x1p-68F;
/// Returns the slack of a ray that rounding does not move. `rounding`: SceneView's.
[[gnu::always_inline]] constexpr float least_slack(float rounding) {
    return rounding * (1 + 0x1p-14F) + slack_floor;
}

/// Rays rounded to float (FilterRays in kernel/shapes/filter.hpp), with the ids of the shapes that
/// they leave, first to last; no_shape twice if they leave none. Filters do not see these shapes.
struct RoundedRays {
    float* origin[3];
    float* direction[3];
    float* slack;
    const std::uint32_t* origin_first;
    const std::uint32_t* origin_last;
    const double* exact_origin[3]; ///< exact, before rounding
    const double* exact_direction[3];
    /// Distances along the exact rays at which the rounded ones start. The search ignores
    /// everything before, and t counts from there. Null: 0.
    const double* before = nullptr;
};

/// Candidates for the nearest crossing of each ray. In and out.
struct Candidates {
    float* first;        ///< the smallest lower bound; infinity without a candidate
    float* second;       ///< the next smallest, of another shape
    std::uint32_t* slot; ///< the shape with the smallest bound; no_slot without a candidate
};

/// Number of random rays from which one list for all is faster, where the hierarchy fits in the
/// cache.
inline constexpr std::size_t long_list = 4096;

/// Factor between a candidate's lower bound and the largest t that can be certain to be the
/// nearest. The search skips everything beyond.
inline constexpr float culling_slack = 1.0F + 0x1p-10F;

/// Occlusion of each ray before t_limit.
struct Occlusions {
    const float* t_limit;
    std::uint8_t* state; ///< in and out: Occlusion
};

/// Result for a ray. Rays that are blocked on input are skipped.
enum Occlusion : std::uint8_t {
    unblocked = 0,
    doubtful = 1, ///< perhaps a shape is in the way, or one that light may pass
    blocked = 2,
};

/// Number of interleaved single rays in the hierarchy at a time. Their state fits in the
/// first-level cache.
inline constexpr int in_flight = 32;

/// Memory for the entries that rays have yet to visit in the hierarchy: pending_entries(levels) for
/// each interleaved ray.
struct Pending {
    std::uint16_t* key; ///< null: no hierarchy is traversed
    std::uint32_t* child;
};
/// Capacity for one ray: 16 empty entries, and then up to 30 for each level. Whichever of the last
/// 16 entries is taken, its children are appended behind the other 15. One write may reach 20
/// entries beyond.
[[gnu::always_inline]] constexpr std::size_t pending_entries(std::uint32_t levels) {
    return std::size_t{16} * (2 * levels + 1);
}

/// Memory of kernels: the above and, if `capacity` is not 0, space for this number of rays (less
/// than 65536) that are traced together.
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
    double focus;                                ///< distance of the plane in focus
    bool orthographic;
};

struct TraceCounters {
    std::uint64_t nodes;  ///< visited by a ray, a list or a frustum
    std::uint64_t shapes; ///< tests of a ray against a shape
    std::uint64_t one_by_one, in_frusta, in_lists,
        in_flight; ///< rays, as in EngineCounters
};

/// Common property of rays: they start at one point, end at one point, or are parallel. Rays that a
/// flat mirror reflects count as rays from the mirror image of their point. Consecutive rays are
/// near each other, so anything that many of them miss need be found only once.
struct Coherence {
    float apex[3];   ///< meaningless if they are parallel
    bool converging; ///< they end at the apex
    bool parallel;
    bool loose;          ///< they are only near each other: the other members are meaningless
    bool beyond;         ///< they start beyond the apex
    float spread = 0.0F; ///< largest distance by which they miss the apex
    /// Consecutive rays that end at one point do not start near each other, or loose ones have
    /// different directions.
    bool scattered = false;
};
constexpr Coherence neighbours{{}, false, false, true, false};

/// Kernels for rays before and after they are traced.
struct RayKernels {
    /// Makes rays through points of the image and of the lens. Without a lens, lens_right and
    /// lens_up are null.
    void (*camera_rays)(const CameraView& camera, std::size_t count, const double* across,
                        const double* upward, const double* lens_right, const double* lens_up,
                        double* const origin[3], double* const direction[3]);

    /// Computes `origin`, `direction` and `slack` from the other members. The slack includes
    /// `rounding`, the largest distance of shapes' floats from their exact numbers.
    void (*round_rays)(std::size_t count, const RoundedRays& rays, float rounding);

    /// Lists the lanes whose candidate is not certain to be the nearest, and those that are
    /// `doubtful` anyway. No candidate is certain if the bound that it has to precede is below
    /// `least`. `t`, `error` and `hit` are those of the candidate, as in Found. Returns the number
    /// of lanes.
    std::size_t (*list_uncertain)(std::size_t count, const Candidates& candidates, const double* t,
                                  const double* error, const std::uint32_t* hit,
                                  const std::uint8_t* doubtful, float least, std::uint32_t* lanes);
};

/// Search the shapes of the kinds in `kind_bits` one by one, and the hierarchy if there is one.
/// `coherence`: null if the rays share no property and are not near each other.
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
    float* lower; ///< lower bounds of t
    std::size_t room, count;
    /// Limit, in and out: candidates beyond it are not listed.
    float limit;
    /// True if RoundedRays has the exact ray: long lists then omit shapes that it certainly misses.
    bool sifts;
};

/// Factor between the limit of a list and the upper bound that it is computed from, so that
/// candidates that are nearly as near are listed, too.
inline constexpr float candidate_tolerance = 1.0F + 0x1p-18F;

/// Crossings in extended precision: t as the sum of two doubles, and a bound on its error.
struct WideCrossings {
    double *high, *low, *error;
    /// Outward normals of length 1. Each component is correctly rounded where `rounded` is 1: one
    /// bit for each of the three. Null: not requested.
    float* normal[3] = {};
    std::uint8_t* rounded = nullptr;
};

/// Pairs of a ray and a shape that it may cross. Pairs beyond the capacity `room` are only counted.
struct PairList {
    std::uint32_t *ray, *slot;
    std::size_t room, count;
};

/// Pairs of a ray and a shape, for which all crossings with t > 0 are computed. The rays do not
/// start on the shapes.
struct CrossingPairs {
    std::size_t count;
    const double* origin[3]; ///< of rays, by ray
    const double* direction[3];
    const double* unit_direction[3]; ///< the same, brought to length 1
    const std::uint32_t* ray;        ///< of a pair; those of one ray are together
    const std::uint32_t* slot;

    /// Out: crossings 2 k and 2 k + 1 of pair k, in order. t is the sum of two doubles, with an
    /// error of at most `error`.
    double *high, *low, *error;
    std::uint32_t* hit; ///< hit_none, hit_doubtful where little is known, or face and hit_entering
    /// Out: unit normals on the outside of the shapes, each component rounded to the nearest float,
    /// or NaN where that is not certain. Null: not requested.
    float* normal[3] = {};
};

/// A node of an expression of shapes: a shape, or an intersection or union of the nodes that
/// follow. A shape that is no part of a solid is an expression by itself.
struct SurfaceNode {
    std::uint32_t end;     ///< index behind the last descendant
    std::uint32_t parent;  ///< meaningless for the root of an expression
    const double* numbers; ///< of a shape; null: an intersection or union
    core::Kind kind;
    bool of_all;   ///< an intersection
    bool is_part;  ///< a part of a solid
    bool reversed; ///< a part whose outside counts as its inside
    bool seen[2];  ///< whether the shape is visible where rays leave it, and enter it
    std::uint32_t id;
    std::uint32_t slot; ///< no_slot: rays do not cross it
};

/// The expressions of a scene, one after the other.
struct SurfaceNodes {
    static constexpr std::uint32_t most = 64;

    const SurfaceNode* node;
    std::uint32_t count; ///< at most `most`
};

/// Kernels for rays that remain in doubt.
struct RefineKernels {
    /// Lists all shapes that ray i may cross before the limit, among those that
    /// TraceKernels::nearest searches. Returns false if the list's capacity does not suffice.
    bool (*list_candidates)(const SceneView& scene, std::uint32_t kind_bits,
                            const RoundedRays& rays, std::size_t i, const Pending& pending,
                            CandidateList& list, TraceCounters& counters);
    /// Repeats MethodKernels::solve in extended precision for the lanes that it left doubtful.
    /// Other lanes are not changed.
    void (*refine)(const SceneView& scene, const Found& found);
    /// Extends the precision of `count` crossings that have been found, at `places` of `found`, for
    /// the exact rays. The error is infinite, and no normal is rounded, for unknown crossings, such
    /// as those of rays that start on the shape.
    void (*widen)(const SceneView& scene, const Found& found, const std::size_t* places,
                  std::size_t count, const WideCrossings& wide);
    /// Adds all pairs that may cross before t_limit, among the shapes that TraceKernels::nearest
    /// searches, in any order. Rays whose t_limit is not positive get no pairs.
    void (*list_all)(const SceneView& scene, std::uint32_t kind_bits, std::size_t count,
                     const RoundedRays& rays, const float* t_limit, const Pending& pending,
                     PairList& list);
    void (*cross_all)(const SceneView& scene, const CrossingPairs& pairs);
    /// Finds the first visible surface of each of `count` rays of `found`, by their `lanes`, as
    /// core::SolidSurfaces describes it. `slot` (in place of Found::slot) is out: no_slot for a ray
    /// that has none. Rays that double arithmetic leaves in doubt are hit_doubtful. Normals are not
    /// computed if Found::normal is null.
    void (*first_surfaces)(const SurfaceNodes& nodes, const Found& found, std::uint32_t* slot,
                           const std::uint32_t* lanes, std::size_t count);
};

} // namespace raylane::simd
