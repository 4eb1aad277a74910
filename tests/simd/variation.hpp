#pragma once

#include "core/shapes/types.hpp"
#include "tests/random.hpp"

#include <utility>

/// Changes any shape by its floats. Files of shapes overload these functions where this does not
/// suffice.
namespace raylane::hard_cases {

using ray_sets::Random;

inline core::Vec3d in_double(const core::Vec3f& v) {
    return core::convert<double>(v);
}

/// Returns the shape, `scale` times as large.
template <class Shape>
Shape scaled(const Shape& shape, double scale) {
    core::Numbers<Shape> floats = core::numbers_of(shape);
    for (float& value : floats)
        value = static_cast<float>(static_cast<double>(value) * scale);
    return core::shape_of<Shape>(floats);
}

/// Returns a long, flat, slender or blunt shape: of proportions that the usual targets do not have.
/// By default, returns the shape itself.
template <class Shape>
Shape extreme(const Shape& shape, Random&) {
    return shape;
}

/// Changes the frame: swaps two coordinates.
template <class Shape>
void swap_axes(Shape& shape, int a, int b) {
    core::Numbers<Shape> floats = core::numbers_of(shape);
    for (int vector = 0; vector < core::number_count<Shape> / 3; ++vector)
        std::swap(floats[3 * vector + a], floats[3 * vector + b]);
    shape = core::shape_of<Shape>(floats);
}

} // namespace raylane::hard_cases
