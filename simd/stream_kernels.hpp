#pragma once

#include "simd/scene_view.hpp"

#include <cstddef>
#include <cstdint>

/// Interface of the kernel units to a caller's rays: how they come in, and how answers go out.
/// Plain data only.
namespace raylane::simd {

struct Coherence;

/// A caller's rays, structure of arrays: values behind `count` may not be read. Limits of floats
/// compare with the float nearest to t, those of doubles with the true one.
template <class Real>
struct CallerRays {
    std::size_t count;
    const Real* origin[3];
    const Real* direction[3]; ///< of any length
    const Real* t_min;        ///< null: 0
    const Real* t_max;        ///< null: infinity
};

/// Rays as kernels have them, structure of arrays of whole packets of 16. The directions meant are
/// the caller's, brought near length 1 by a power of two: that is exact, and lets no product in the
/// solvers over- or underflow. A ray that is none, or has no room between its limits, has t_most
/// < 0, and numbers that mean nothing.
struct StreamRays {
    double* origin[3];
    double* direction[3]; ///< unit
    double* meant_direction[3];
    double* meant_length;
    double* unit;     ///< the caller's t per t of the ray meant: the power of two
    double* per_unit; ///< the same per t of the unit direction, within 2^-51 of itself
    /// Crossings of the ray meant at less than this t, or at it unless stream_tie_counts, do not
    /// count; 0: all with t > 0 do.
    double* t_after;
    double* start;  ///< the same by the length of the direction: where the ray begins to count
    double* t_most; ///< likewise; no crossing behind it counts
    std::uint32_t* bits;
};
/// Bit of StreamRays::bits: a crossing at t_after counts.
inline constexpr std::uint32_t stream_tie_counts = 0x20000;

/// Arrays of a caller's for hits. Null: not wanted.
struct CallerHits {
    float* t;
    double* t_double;
    float* normal[3];
    std::uint32_t* shape;
    std::uint8_t* entering;
    std::uint8_t* face;
};

/// What hits have to be at or before: the caller's floats, if not null, as t in float is, or else,
/// if `truly`, StreamRays::t_most.
struct UpperLimits {
    const float* t_max;
    bool truly;
};

/// Lanes for which more is to be done, as kernels list them.
struct LeftOver {
    std::uint32_t* doubtful; ///< their floats are in doubt; nothing has been stored
    std::uint32_t* unsharp;  ///< hits of which t_double alone is
    std::size_t doubtful_count, unsharp_count;
};

/// Hits of lanes, as in Found.
struct StreamHits {
    const std::uint32_t* slot;
    const std::uint32_t* hit;
    const double* t;
    const double* error;
    const double* normal[3];
};

/// Kernels for streams of a caller's rays.
struct StreamKernels {
    /// Takes rays in. Returns how many are none.
    std::size_t (*take)(const CallerRays<float>& rays, const StreamRays& taken);
    std::size_t (*take_doubles)(const CallerRays<double>& rays, const StreamRays& taken);

    /// Looks at whole rays for what they have in common. Returns false if that is nothing.
    /// `radius`: of the scene.
    bool (*find_coherence)(std::size_t count, const StreamRays& rays, float radius,
                           Coherence& coherence);

    /// Hands hits of the first `count` rays over to the caller: t in units of the caller's. `left`
    /// has room for `count` each.
    void (*hand_over)(const SceneView& scene, std::size_t count, const UpperLimits& limits,
                      const StreamRays& taken, const StreamHits& found, const CallerHits& hits,
                      LeftOver& left);
};

} // namespace raylane::simd
