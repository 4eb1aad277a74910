#pragma once

#include "simd/units/kernels.hpp"

#include <cstddef>

/// Interface of the filters for tests. It is plain data, as no inline function may be shared with
/// units that are built for newer processors.
namespace raylane::simd {

/// 16 shapes of one kind, structure of arrays: value k of lane i at values[k][i]; ids in the bits
/// of floats.
struct ShapeBlock {
    const float (*values)[16];
    const float* ids;
};

/// Structure of arrays, readable and writable up to whole packets of 16.
struct FilterStream {
    std::size_t count;
    const float* origin[3];
    const float* direction[3];
    const float* slack;
    /// Out: Bounds, with masks as 1 or 0; may_meet, 1 for filters that do not have it; and
    /// contradicts, 1 if the obstacle differs from the bounds.
    float *possible, *lower, *certain, *upper, *may_meet, *contradicts;
};

struct FilterChecks {
    /// Tests one shape of a block with all rays.
    void (*bound_rays)(core::Kind kind, const ShapeBlock& block, int lane,
                       const FilterStream& stream);
    /// Tests one ray with all 16 shapes of a block. Results go to the stream's first 16 entries.
    void (*bound_block)(core::Kind kind, const ShapeBlock& block, const FilterStream& stream,
                        std::size_t ray);
};

/// Defined in the kernel unit of each instruction set.
template <Isa isa>
FilterChecks filter_checks();

} // namespace raylane::simd
