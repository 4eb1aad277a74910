#pragma once

#include "core/scene/material.hpp"
#include "core/shapes/shape.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raylane::simd {

/// Request for all crossings.
struct CrossingRequest {
    std::size_t most = 0; ///< largest number per ray, its first ones; 0: all
    bool normals = false, normals_double = false;
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
    std::array<std::vector<float>, 3> normal;         ///< if requested
    std::array<std::vector<double>, 3> normal_double; ///< if requested
};

/// Solids that points are in, by their ids.
struct SolidRows : Rows {
    std::vector<core::ShapeId> shape;
    std::vector<std::uint8_t> inside, on_surface;
};

/// Lengths of rays inside of bodies, as in core::BodyLength.
struct LengthRows : Rows {
    std::vector<std::uint32_t> body;
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
    for (std::size_t axis = 0; axis < 3; ++axis)
        visit(a.normal_double[axis], b.normal_double[axis]);
}
template <class Visit>
void for_each_column(SolidRows& a, SolidRows& b, const Visit& visit) {
    visit(a.shape, b.shape);
    visit(a.inside, b.inside);
    visit(a.on_surface, b.on_surface);
}
template <class Visit>
void for_each_column(LengthRows& a, LengthRows& b, const Visit& visit) {
    visit(a.body, b.body);
    visit(a.length, b.length);
}

} // namespace raylane::simd
