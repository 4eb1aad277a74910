#pragma once

#include <cstddef>
#include <cstdint>

/// What a kernel unit offers: one per instruction set, all alike. Plain data only, so that nothing
/// inline is shared with the units that are built for newer processors.
namespace raylane::simd {

/// Rays and what they have hit so far, structure of arrays: each array has `count` values, rounded
/// up to whole packets of 16. A lane without a ray has t = -1: nothing is nearer.
struct RayStream {
    std::size_t count;
    const float* origin[3];
    const float* direction[3];
    /// The shapes (ids in the bits of floats, first to last) that the ray leaves, all ones if none;
    /// the face of it; and whether it goes to the inside, 1 or 0.
    const float* departed_first;
    const float* departed_last;
    const float* departed_face;
    const float* departed_inward;
    /// The hit: t is what it must be less than when it goes in. entering is 1 or 0.
    float* t;
    float* shape;
    float* face;
    float* entering;
};

/// 16 shapes of one kind, structure of arrays: value k of lane i at values[k][i]; ids in the bits
/// of floats.
struct ShapeBlock {
    const float (*values)[16];
    const float* ids;
};

/// core::Kind by number.
using KindNumber = std::uint8_t;

struct Kernels {
    const char* name;
    int lanes;

    /// One shape of a block against all rays: nearest hits. At equal t the lower id wins.
    void (*intersect_rays)(KindNumber kind, const ShapeBlock& block, int lane, RayStream& rays);

    /// One ray against all shapes of a block.
    void (*intersect_block)(KindNumber kind, const ShapeBlock& block, RayStream& rays,
                            std::size_t ray);

    /// The same for rays that only ask whether anything is before their t: it becomes -1, and the
    /// lane inert, where there is.
    void (*occlude_rays)(KindNumber kind, const ShapeBlock& block, int lane, RayStream& rays);
    void (*occlude_block)(KindNumber kind, const ShapeBlock& block, RayStream& rays,
                          std::size_t ray);

    /// The unit outward normals of one shape of a block at n points. `face` as in RayStream.
    void (*outward_normals)(KindNumber kind, const ShapeBlock& block, int lane, std::size_t count,
                            const float* const point[3], const float* face, float* const normal[3]);
};

const Kernels& kernels_sse42();
const Kernels& kernels_avx2();
const Kernels& kernels_avx512();

} // namespace raylane::simd
