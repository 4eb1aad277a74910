#pragma once

#include "core/numbers/formula_program.hpp"
#include "core/optics/soft_light.hpp"

#include <cstddef>
#include <cstdint>

/// Shading by the kernel units: plain data only. Arrays have `count` values and are readable and
/// writable up to whole packets of 16; colours are linear RGB, vectors x, y, z.
namespace raylane::simd {

/// core::Material, with its numbers in double.
struct MaterialView {
    double ambient, diffuse, specular, exponent;
    double reflectivity, transmission, index, opacity;
    core::Reflection reflection;
    core::Highlight highlight;
    bool transmits, reflects;

    core::PatternKind pattern;
    std::uint8_t axes;
    double colors[2][3];
    double size;
    double direction[3]; ///< stripes, a unit vector
    double from[3];      ///< gradient
    double run[3];       ///< gradient: from `from` to `to`, divided by its squared length
    const core::FormulaProgram* formula; ///< null for other patterns
    bool in_object_space;                ///< the pattern's points are HitPaths::pattern
    bool is_on_surface;                  ///< the colours are HitPaths::pattern
};

struct LightView {
    bool is_point;
    double position[3];
    double to_light[3]; ///< directional: a unit vector
    double color[3];
};

struct FogView {
    core::FogKind kind;
    double color[3];
    double start, end, density;
};

/// Paths and their hits, by lane.
struct HitPaths {
    const double* origin[3];
    const double* direction[3];
    const double* throughput[3];
    const double* t;         ///< distance to the hit
    const double* travelled; ///< distance on the same line before the origin; null: 0
    const double*
        way; ///< from the origin to the hit point: t, or 0 where the origin is the hit point
    const double* normal[3]; ///< unit, outward
    const double* shading_normal[3];
    const std::uint32_t* hit;  ///< Found::hit's bits
    const double* on_shape[2]; ///< core::coordinates_on(); null if no formula needs them
    /// Points of patterns in object space, colours of images; null if no material needs them.
    const double* pattern[3];
};

/// Columns for paths inside of transmissive materials, by position in the sorted wave. Absent in
/// scenes without such materials.
struct MediumColumns {
    double* index_before;
    double* index_behind;
    double* inside;        ///< 1 in a medium, otherwise 0
    double* absorption[3]; ///< per unit of length
};

/// The surfaces that a wave has hit, in the order of shading: sorted by material.
struct Surfaces {
    double* point[3];
    double* flat_normal[3]; ///< unit, on the side that the ray comes from
    double* normal[3];      ///< the normal to shade with
    double* direction[3];   ///< of the ray
    double* throughput[3];  ///< after the segment's fog or absorption
    double* own[3];         ///< the material's colour here
    double* radiance[3];    ///< light seen, times throughput, without direct light and further rays
    double* behind[3]; ///< throughput of the path behind transparent surfaces; not set for others
};

/// Positions `begin` to `end` of a sorted wave have this one material.
struct Run {
    const MaterialView* material;
    std::size_t begin, end;
};

/// Rays that surfaces spawn. `parent` is the surface's position, a whole number. Kernels append and
/// increase `count`.
struct SpawnedRays {
    std::size_t count;
    double* origin[3];
    double* direction[3]; ///< unit
    double* weight[3];    ///< shadow rays: light seen if nothing is in the way; others: throughput
    double* distance;     ///< shadow rays: to the light
    double* parent;
};

struct ShadeKernels {
    /// Shades the surfaces of `run`, from the lanes with these numbers. `media`: null in kernels
    /// for scenes without media.
    void (*surfaces)(const Run& run, const std::uint32_t* lanes, const HitPaths& paths,
                     const FogView& fog, const MediumColumns* media, const Surfaces& surfaces);

    /// Appends the shadow rays that are worth tracing.
    void (*light)(const Run& run, const LightView& light, const Surfaces& surfaces,
                  SpawnedRays& shadows);

    /// Computes points in [0, 1)^2: core::shuffled_point of each key and of the number plus `more`.
    void (*light_points)(std::size_t count, const std::uint64_t* keys, const std::uint32_t* numbers,
                         std::uint32_t more, double* u, double* v);

    /// Appends the shadow rays to points of a light with a size. (u, v), by position, selects the
    /// point. Each sample counts for `part` of the light.
    void (*soft_light)(const Run& run, const core::SoftLight& light, double part, const double* u,
                       const double* v, const Surfaces& surfaces, SpawnedRays& shadows);

    /// Appends reflected rays and, where the material transmits, transmitted ones. Rays that weigh
    /// less than `min_weight` are dropped. `media` as above.
    void (*spawn)(const Run& run, double min_weight, const MediumColumns* media,
                  const Surfaces& surfaces, SpawnedRays& reflected, SpawnedRays& transmitted);
};

} // namespace raylane::simd
