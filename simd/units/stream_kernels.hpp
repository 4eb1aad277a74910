#pragma once

#include "simd/units/scene_view.hpp"

#include <cstddef>
#include <cstdint>

/// Interface between the kernel units and a caller's rays: intake of rays and output of answers.
/// Plain data only.
namespace raylane::simd {

struct Coherence;
struct Found;

/// `count` rays, structure of arrays: the points origin + t direction with t_min < t <= t_max.
/// Component a of ray i is origin[a][i]. Directions may have any length but zero. Values beyond
/// `count` must not be read. Limits are compared with the number of their type that is nearest to
/// t.
template <class Real>
struct RayStream {
    std::size_t count = 0;
    const Real* origin[3] = {};
    const Real* direction[3] = {};
    const Real* t_min = nullptr; ///< null: 0; negative values count as 0
    const Real* t_max = nullptr; ///< null: infinity
    /// Ids of shapes that rays leave, or no_shape. Such a ray starts exactly on that surface, on
    /// the face that HitStream::face reported. It goes to the inside (the back) if origin_inward is
    /// 1, to the outside if it is 0; if it is 2, the direction decides. Null: no ray leaves a
    /// shape; the face is the body; the direction decides.
    const std::uint32_t* origin_shape = nullptr;
    const std::uint8_t* origin_face = nullptr;
    const std::uint8_t* origin_inward = nullptr;
};

/// Rays in the kernels' format, structure of arrays of whole packets of 16. The exact directions
/// (`exact_direction`) are the caller's, scaled to about length 1 by a power of two. Scaling is
/// exact and prevents overflow and underflow of products in the solvers. These are proven for
/// coordinates that are 0 or of magnitude 2^-149 to 2^128, like floats, and for components of
/// directions down to 2^-276 of the largest. A ray with other doubles, an invalid one, and one that
/// has no interval between its limits has t_limit < 0; its other numbers are meaningless.
struct StreamRays {
    double* origin[3];
    double* direction[3]; ///< unit
    double* exact_direction[3];
    double* exact_length;
    double* unit; ///< the caller's t per t of the exact ray: the power of two
    double*
        per_unit; ///< the same per t of the unit direction, with a relative error of at most 2^-51
    /// Lower limit in t of the exact ray. Crossings before it do not count. Crossings at it count
    /// only with stream_tie_counts. With stream_half_ulp, the limit is half an ulp more than this
    /// double. 0: all crossings with t > 0 count.
    double* t_after;
    double* start;   ///< t_after times the direction's length: where the ray begins to count
    double* t_limit; ///< the upper limit, likewise times the length; no crossing behind it counts
    std::uint32_t* bits;
};
/// Bit of StreamRays::bits: a crossing at t_after counts.
inline constexpr std::uint32_t stream_tie_counts = 0x20000;
/// The limit is half way from t_after to the next double.
inline constexpr std::uint32_t stream_half_ulp = 0x40000;

/// Hits of rays, by ray. Null: not requested.
struct HitStream {
    float* t = nullptr;               ///< infinity: no hit
    float* normal[3] = {};            ///< unit, on the outside (the front); 0: no hit
    std::uint32_t* shape = nullptr;   ///< the shape's id; no_shape: no hit
    std::uint8_t* entering = nullptr; ///< 1: from outside (the front); 0: from inside, or no hit
    std::uint8_t* face = nullptr;     ///< for RayStream::origin_face
    double* t_double = nullptr;       ///< the double nearest to the exact t; infinity: no hit
    std::uint8_t* touching = nullptr; ///< as in CrossingRows, with Precision::exact; 0: no hit

    [[gnu::always_inline]] bool wants_normals() const {
        return normal[0] != nullptr || normal[1] != nullptr || normal[2] != nullptr;
    }
};

/// Upper limits of hits. `t_max`, if not null: the caller's floats, compared with the float nearest
/// to t. Otherwise, if `are_doubles`: StreamRays::t_limit, and half an ulp more.
struct UpperLimits {
    const float* t_max;
    bool are_doubles;
};

/// Lanes that need more work, as kernels list them.
struct LeftOver {
    std::uint32_t* doubtful; ///< their floats are in doubt; nothing has been stored
    std::uint32_t* unsharp;  ///< hits of which only t_double is in doubt
    std::size_t doubtful_count, unsharp_count;
};

/// The spheres that rays leave, by ray.
struct LeftSpheres {
    static constexpr std::size_t size = 64;

    double center[3][size] = {}, radius[size] = {};
};

/// The sides of surfaces to which rays go, by ray as bit. Rays in neither are undecided.
struct DepartureSides {
    std::uint64_t outside = 0, inside = 0;
};

/// Kernels for streams of a caller's rays.
struct StreamKernels {
    /// Takes rays in. Returns the number of invalid or empty ones.
    std::size_t (*take)(const RayStream<float>& rays, const StreamRays& taken);
    std::size_t (*take_doubles)(const RayStream<double>& rays, const StreamRays& taken);

    /// Finds the sides to which rays go that leave spheres, by the operations of
    /// core::clear_side_of_departure(). `count`: at most LeftSpheres::size.
    DepartureSides (*find_sides)(std::size_t count, const StreamRays& rays,
                                 const LeftSpheres& spheres, double share_of_size);

    /// Finds a property that all of the first `count` rays share. Returns false if they share none.
    /// `radius`: of the scene. `max_spread`: mean step between origins that have nothing else in
    /// common, in radii of the scene.
    bool (*find_coherence)(std::size_t count, const StreamRays& rays, float radius,
                           float max_spread, Coherence& coherence);

    /// Hands the hits that were found over to the caller, with t in the caller's units. Each list
    /// of `left` has capacity for as many lanes.
    void (*hand_over)(const SceneView& scene, const UpperLimits& limits, const StreamRays& taken,
                      const Found& found, const HitStream& hits, LeftOver& left);
};

} // namespace raylane::simd
