#pragma once

#include "simd/isa_name.hpp"
#include "simd/scene_view.hpp"
#include "simd/shade_kernels.hpp"
#include "simd/stream_kernels.hpp"
#include "simd/trace_kernels.hpp"

#include <cstddef>
#include <cstdint>

/// Interface of a kernel unit: one per instruction set, all alike. Plain data only, so that nothing
/// inline is shared with the units that are built for newer processors.
namespace raylane::simd {

/// Rays with the shapes that were found for them, structure of arrays of `count` values, readable
/// and writable up to whole packets of 16. Directions have a length of 1 +- 2^-48.
struct Found {
    std::size_t count;
    const double* origin[3];
    const double* direction[3];
    /// The shapes that the ray leaves, first to last; `no_shape` twice if none.
    const std::uint32_t* origin_first;
    const std::uint32_t* origin_last;
    const std::uint32_t* origin_bits; ///< origin_bits
    /// The shape's slot, or no_slot: such lanes are left as they are.
    const std::uint32_t* slot;

    /// Out: its first crossing with t > 0 (for a start on the surface, as core::Start has it).
    double* t;
    double* error;     ///< exact: what t may be off by, at most 2^-27 t unless doubtful; others: 0
    double* normal[3]; ///< unit, outward
    double* shading_normal[3]; ///< interpolated on smooth triangles, else the same; may be null
    std::uint32_t* hit;        ///< bits, as below

    /// Directions meant, of any length, and their lengths, where `direction` is these brought to
    /// length 1. What is certain is so of the rays meant. Null: directions are exact.
    const double* meant_direction[3] = {};
    const double* meant_length = nullptr;
    /// True if points are wanted, so that t has to hold one.
    bool holds_points = true;
    /// Limits below, as StreamRays has them. What is crossed before or at them is not looked at; of
    /// rays that cross a shape there, finish leaves in doubt whether and where they do behind it.
    /// Null: there are none.
    const double* t_after = nullptr;
    const double* start = nullptr;
};

/// Bits of Found::origin_bits.
inline constexpr std::uint32_t origin_face = 0xFF;
inline constexpr std::uint32_t origin_inward = 0x100;

/// Bits of Found::hit.
inline constexpr std::uint32_t hit_face = 0xFF;
inline constexpr std::uint32_t hit_entering = 0x100;
inline constexpr std::uint32_t hit_doubtful = 0x200; ///< not certain; the rest means nothing
inline constexpr std::uint32_t hit_none = 0x400;     ///< certainly none; the rest means nothing
inline constexpr std::uint32_t hit_normal_doubtful = 0x800; ///< too little known for a float
inline constexpr std::uint32_t hit_normal_unknown = 0x1000;

/// Kernels that trace by one core::Precision.
struct MethodKernels {
    TraceKernels trace;
    /// First crossings of rays with the shapes that were found for them. The same bits in every
    /// unit.
    void (*finish)(const SceneView& scene, const Found& found);
    /// The same, and more: what is certain to be missed is said to be, and hit_normal_doubtful.
    void (*finish_all)(const SceneView& scene, const Found& found);
    RefineKernels refine; ///< null where nothing is
    /// Both at once, in scenes without a hierarchy; null where that would not do. Candidates are in
    /// and out, as TraceKernels::nearest has them; what came in is not finished.
    void (*nearest_of_few)(const SceneView& scene, std::uint32_t kind_bits, const Found& found,
                           const Candidates& candidates, TraceCounters& counters);
};
inline constexpr int method_count = 4;

struct Kernels {
    const char* name;
    int lanes;

    RayKernels rays;
    StreamKernels stream;
    MethodKernels methods[method_count]; ///< core::Precision by number
    /// shade[media][fog]: for scenes without and with transmissive materials, and fog. Four, as
    /// both are asked of every lane; what concerns one material, or all lanes alike, is asked per
    /// run or wave and costs nothing where it is absent.
    ShadeKernels shade[2][2];
};

/// The parts of Kernels. Each file of units/ defines some of them for each instruction set.
template <Isa isa>
struct KernelParts {
    static int lanes();
    static RayKernels rays();
    static StreamKernels stream();
    static ShadeKernels shade(bool media, bool fog);
    /// core::Precision::exact in its parts, and the precisions that it is compared with.
    static decltype(TraceKernels::nearest) nearest();
    static decltype(TraceKernels::occluded) occluded();
    static decltype(MethodKernels::finish) finish();
    static decltype(MethodKernels::finish) finish_all();
    static RefineKernels refine();
    static MethodKernels in_float(bool textbook);
    static MethodKernels in_double();
};

} // namespace raylane::simd
