#pragma once

#include "core/shapes/types.hpp"

#include <limits>

namespace raylane::core {

/// Number of shapes in a block: as many as the widest packet has lanes.
inline constexpr int block_size = 16;

/// The floats of 16 shapes of one kind, or the floats nearest to their numbers, structure of
/// arrays: value k of lane i is values[k][i]. An empty lane holds NaN and no_shape.
///
/// Drawing: bench/drawings/node_and_block.svg
template <class Shape>
struct alignas(64) Block {
    float values[number_count<Shape>][block_size];
    ShapeId ids[block_size];

    Block() {
        for (auto& row : values)
            for (float& value : row)
                value = std::numeric_limits<float>::quiet_NaN();
        for (ShapeId& id : ids)
            id = no_shape;
    }

    Shape get(int lane) const {
        Numbers<Shape> floats;
        for (int k = 0; k < number_count<Shape>; ++k)
            floats[k] = values[k][lane];
        return shape_of<Shape>(floats);
    }

    void set(int lane, const Shape& shape, ShapeId id) {
        const Numbers<Shape> floats = numbers_of(shape);
        for (int k = 0; k < number_count<Shape>; ++k)
            values[k][lane] = floats[k];
        ids[lane] = id;
    }
};

/// The exact numbers of the same 16 shapes, if they are not floats. It has as many rows as a Block
/// including its ids, so that positions in both have the same offset from the table's start.
template <class Shape>
struct alignas(64) DoubleBlock {
    double values[number_count<Shape> + 1][block_size];

    DoubleBlock() {
        for (auto& row : values)
            for (double& value : row)
                value = std::numeric_limits<double>::quiet_NaN();
    }

    InDouble<Shape> get(int lane) const {
        Numbers<InDouble<Shape>> numbers;
        for (int k = 0; k < number_count<Shape>; ++k)
            numbers[k] = values[k][lane];
        return shape_of<InDouble<Shape>>(numbers);
    }

    void set(int lane, const InDouble<Shape>& shape) {
        const Numbers<InDouble<Shape>> numbers = numbers_of(shape);
        for (int k = 0; k < number_count<Shape>; ++k)
            values[k][lane] = numbers[k];
    }
};

} // namespace raylane::core
