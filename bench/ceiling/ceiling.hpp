#pragma once

#include "simd/isa_name.hpp"

#include <cstddef>
#include <cstdint>

/// The plainest fast loop there is for a few shapes of one kind: what raylane's methods in float
/// are held to.
namespace raylane::bench {

struct CeilingRays {
    std::size_t count; ///< a multiple of 16
    const float* origin[3];
    const float* direction[3]; ///< of length 1
};

struct CeilingHits {
    float* t;             ///< infinity: nothing
    std::uint32_t* shape; ///< by number; anything where there is nothing
    float* normal[3];
};

/// Nearest of `shape_count` shapes, each of which is some floats (see prepare.hpp).
using CeilingLoop = void (*)(const float* numbers, int shape_count, const CeilingRays& rays,
                             const CeilingHits& hits);

/// By core::Kind.
struct CeilingUnit {
    CeilingLoop sphere, plane, disc, triangle, box, open_cylinder, capped_cylinder, open_cone,
        capped_cone, quadric, ellipsoid;
};

/// Defined in the kernel unit of each instruction set.
template <simd::Isa isa>
CeilingUnit ceiling();

} // namespace raylane::bench
