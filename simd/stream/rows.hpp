#pragma once

#include "core/scene/material.hpp"
#include "core/shapes/shape.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raylane::simd {

/// Points, structure of arrays: coordinate a of point i is at[a][i].
template <class Real>
struct PointStream {
    std::size_t count = 0;
    const Real* at[3] = {};
};

/// Any number of answers for each ray or point: those of i are in the columns from first[i] up to
/// first[i + 1].
struct Rows {
    std::vector<std::uint64_t> first{0};
};

/// Crossings of rays in their order, as described at raylane::CrossingRows.
struct CrossingRows : Rows {
    std::vector<double> t;
    std::vector<core::ShapeId> shape;
    std::vector<std::uint8_t> entering, face, tied, touching;
    std::array<std::vector<float>, 3> normal; ///< if requested
};

/// Solids that points are in, by their ids.
struct SolidRows : Rows {
    std::vector<core::ShapeId> shape;
    std::vector<std::uint8_t> on_surface;
};

/// Lengths of rays inside of materials' solids, by the materials' indices.
struct LengthRows : Rows {
    std::vector<core::MaterialIndex> material;
    std::vector<double> length;
};

/// Calls visit(columns of a, columns of b).
template <class Visit>
void for_each_column(CrossingRows& a, CrossingRows& b, const Visit& visit) {
    visit(a.t, b.t);
    visit(a.shape, b.shape);
    visit(a.entering, b.entering);
    visit(a.face, b.face);
    visit(a.tied, b.tied);
    visit(a.touching, b.touching);
    for (std::size_t axis = 0; axis < 3; ++axis)
        visit(a.normal[axis], b.normal[axis]);
}
template <class Visit>
void for_each_column(SolidRows& a, SolidRows& b, const Visit& visit) {
    visit(a.shape, b.shape);
    visit(a.on_surface, b.on_surface);
}
template <class Visit>
void for_each_column(LengthRows& a, LengthRows& b, const Visit& visit) {
    visit(a.material, b.material);
    visit(a.length, b.length);
}

} // namespace raylane::simd
