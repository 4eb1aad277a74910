#pragma once

#include "simd/isa/isa_name.hpp"

#include <cstddef>
#include <cstdint>

/// The simplest fast loop for a few shapes of one kind: an upper bound for the speed of raylane's
/// float methods.
namespace raylane::bench {

struct CeilingRays {
    std::size_t count; ///< a multiple of 16
    const float* origin[3];
    const float* direction[3]; ///< of length 1
};

struct CeilingHits {
    float* t;             ///< infinity: no hit
    std::uint32_t* shape; ///< by number; any value without a hit
    float* normal[3];
};

/// Finds the nearest of `shape_count` shapes, each of which is several floats (see prepare.hpp).
using CeilingLoop = void (*)(const float* numbers, int shape_count, const CeilingRays& rays,
                             const CeilingHits& hits);

/// The loops, by core::Kind.
struct CeilingUnit {
    CeilingLoop sphere, plane, disc, triangle, box, open_cylinder, capped_cylinder, open_cone,
        capped_cone, quadric, ellipsoid;
};

/// Defined in the kernel unit of each instruction set.
template <simd::Isa isa>
CeilingUnit ceiling();

} // namespace raylane::bench
