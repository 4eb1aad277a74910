#pragma once

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
    bool transmits, reflects;

    core::PatternKind pattern;
    std::uint8_t axes;
    double colors[2][3];
    double size;
    double direction[3]; ///< stripes, a unit vector
    double from[3];      ///< gradient
    double run[3];       ///< gradient: from `from` to `to`, over its squared length
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

/// Paths and what they have hit, by lane.
struct HitPaths {
    const double* origin[3];
    const double* direction[3];
    const double* throughput[3];
    const double* t;         ///< distance that they have gone
    const double* travelled; ///< on the same line, before the origin; null: nothing
    const double* way;       ///< from the origin to the hit point: t, unless that is where it is
    const double* normal[3]; ///< unit, outward
    const double* shading_normal[3];
    const std::uint32_t* hit; ///< Found::hit's bits
};

/// Columns of paths inside of transmissive materials, by position in the sorted wave. Absent where
/// a scene has none.
struct MediumColumns {
    double* index_before;
    double* index_behind;
    double* inside;        ///< 1 in a medium, else 0
    double* absorption[3]; ///< per unit of length
};

/// The surfaces that a wave has hit, in the order in which they are shaded: by material.
struct Surfaces {
    double* point[3];
    double* flat_normal[3]; ///< unit, on the side that the ray comes from
    double* normal[3];      ///< the same to shade with
    double* direction[3];   ///< of the ray
    double* throughput[3];  ///< behind the segment's fog or absorption
    double* own[3];         ///< the material's colour here
    double* radiance[3];    ///< light seen, times throughput, without lights and further rays
    double* behind[3];      ///< throughput of what is behind see-through surfaces; else not set
};

/// Positions `begin` to `end` of a sorted wave have one material.
struct Run {
    const MaterialView* material;
    std::size_t begin, end;
};

/// Rays made by surfaces; `parent` is the surface's position, a whole number. `count` grows.
struct SpawnedRays {
    std::size_t count;
    double* origin[3];
    double* direction[3]; ///< unit
    double* weight[3]; ///< shadow rays: what is seen if nothing is in the way; others: throughput
    double* distance;  ///< shadow rays: to the light
    double* parent;
};

struct ShadeKernels {
    /// Surfaces begin to end from the lanes with these numbers. `media`: null where the kernels are
    /// for scenes without.
    void (*surfaces)(const Run& run, const std::uint32_t* lanes, const HitPaths& paths,
                     const FogView& fog, const MediumColumns* media, const Surfaces& surfaces);

    /// The shadow rays that are worth tracing.
    void (*light)(const Run& run, const LightView& light, const Surfaces& surfaces,
                  SpawnedRays& shadows);

    /// Points in [0, 1)^2: core::shuffled_point of keys and of the numbers that are `more` than
    /// these.
    void (*light_points)(std::size_t count, const std::uint64_t* keys, const std::uint32_t* numbers,
                         std::uint32_t more, double* u, double* v);

    /// The same to points of a light with a size: (u, v), by position, says which, and each sample
    /// counts for `part` of the light.
    void (*soft_light)(const Run& run, const core::SoftLight& light, double part, const double* u,
                       const double* v, const Surfaces& surfaces, SpawnedRays& shadows);

    /// Reflected rays, and transmitted ones where the material transmits. What weighs less than
    /// `min_weight` is dropped. `media` as above.
    void (*spawn)(const Run& run, double min_weight, const MediumColumns* media,
                  const Surfaces& surfaces, SpawnedRays& reflected, SpawnedRays& transmitted);
};

} // namespace raylane::simd
