#pragma once

#include "simd/isa/isa_name.hpp"
#include "simd/units/scene_view.hpp"
#include "simd/units/shade_kernels.hpp"
#include "simd/units/stream_kernels.hpp"
#include "simd/units/trace_kernels.hpp"

#include <cstddef>
#include <cstdint>

/// Interface of the kernel units. Each instruction set has one unit, and all have this interface.
/// Plain data only, so that no inline function is shared with the units built for newer processors.
namespace raylane::simd {

/// Rays with the shapes that were found for them: a structure of arrays of `count` values, readable
/// and writable up to whole packets of 16. Directions have a length of 1 +- 2^-48.
struct Found {
    std::size_t count;
    const double* origin[3];
    const double* direction[3];
    /// Ids of the shapes that the ray leaves, first to last; no_shape twice if it leaves none.
    const std::uint32_t* origin_first;
    const std::uint32_t* origin_last;
    const std::uint32_t* origin_bits; ///< origin_face and origin_inward
    /// Slot of the shape that was found, or no_slot: such lanes are not changed.
    const std::uint32_t* slot;

    /// Out: t of the first crossing with t > 0. For a ray that starts on the shape, t = 0 is left
    /// out as core::Start describes.
    double* t;
    double* error; ///< exact: bound on the error of t, at most 2^-27 t unless doubtful; others: 0
    double* normal[3];         ///< unit, outward
    double* shading_normal[3]; ///< interpolated on smooth triangles, otherwise the same as normal;
                               ///< may be null
    std::uint32_t* hit;        ///< bits, as below

    /// Exact directions, of any length, and their lengths. `direction` is then their normalised
    /// form, and results that are certain hold for the exact rays. Null: `direction` is exact.
    const double* exact_direction[3] = {};
    const double* exact_length = nullptr;
    /// True if hit points are wanted: t is then certain only if it is accurate enough for a point.
    bool holds_points = true;
    /// Lower limits, as in StreamRays. Crossings before or at them are ignored. If a ray crosses
    /// the shape there, solve leaves in doubt whether and where it crosses the shape behind the
    /// limit. Null: no limits.
    const double* t_after = nullptr;
    const double* start = nullptr;
};

/// Bits of Found::origin_bits.
inline constexpr std::uint32_t origin_face = 0xFF;
inline constexpr std::uint32_t origin_inward = 0x100;

/// Bits of Found::hit.
inline constexpr std::uint32_t hit_face = 0xFF;
inline constexpr std::uint32_t hit_entering = 0x100;
inline constexpr std::uint32_t hit_doubtful = 0x200; ///< not certain; other bits are meaningless
inline constexpr std::uint32_t hit_none = 0x400; ///< certainly no hit; other bits are meaningless
inline constexpr std::uint32_t hit_normal_doubtful = 0x800; ///< too uncertain to round to float
inline constexpr std::uint32_t hit_normal_unknown = 0x1000;
/// The shape is a part of a solid whose outside counts, and the normal is that of the solid.
/// Entering the shape is leaving the solid. Only RefineKernels::first_surfaces finds such hits.
inline constexpr std::uint32_t hit_reversed = 0x2000;

/// Kernels that trace with one core::Precision.
struct MethodKernels {
    TraceKernels trace;
    /// Solves the first crossing of each ray with the shape that was found for it. Results are the
    /// same bits in every unit.
    void (*solve)(const SceneView& scene, const Found& found);
    /// Same as solve. It also sets hit_none where a ray certainly misses, and hit_normal_doubtful.
    void (*solve_all)(const SceneView& scene, const Found& found);
    RefineKernels refine; ///< null if the precision refines nothing
    /// Searches and solves in one pass, in scenes without a hierarchy. Candidates are in and out,
    /// as in TraceKernels::nearest; candidates that came in are not crossing. Null if the precision
    /// has no such kernel.
    void (*nearest_of_few)(const SceneView& scene, std::uint32_t kind_bits, const Found& found,
                           const Candidates& candidates, TraceCounters& counters);
};
inline constexpr int method_count = 4;

struct Kernels {
    const char* name;
    int lanes;

    RayKernels rays;
    StreamKernels stream;
    MethodKernels methods[method_count]; ///< indexed by core::Precision
    /// shade[media][fog]: for scenes without and with transmissive materials, and without and with
    /// fog. These two have variants because every lane depends on them. A property of one material,
    /// or of all lanes alike, is checked once per run or wave and costs nothing where it is absent.
    ShadeKernels shade[2][2];
};

/// The parts of Kernels. Each file of units/ defines some of them for each instruction set.
template <Isa isa>
struct KernelParts {
    static int lanes();
    static RayKernels rays();
    static StreamKernels stream();
    static ShadeKernels shade(bool media, bool fog);
    /// The parts of core::Precision::exact, and the precisions that it is compared with.
    static decltype(TraceKernels::nearest) nearest();
    static decltype(TraceKernels::occluded) occluded();
    static decltype(MethodKernels::solve) solve();
    static decltype(MethodKernels::solve) solve_all();
    static RefineKernels refine();
    static MethodKernels in_float(bool textbook);
    static MethodKernels in_double();
};

} // namespace raylane::simd
