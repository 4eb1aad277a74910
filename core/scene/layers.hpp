#pragma once

#include "core/scene/region.hpp"
#include "core/shapes/shape.hpp"
#include "core/solids/solid.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace raylane::core {

/// What a picture's pixels show beside their colours: what the ray through the middle of each one,
/// and the middle of the lens, hits first of what can be seen from there, transmissive or not. In
/// arrays by pixel, rows from the top down.
struct Layers {
    int width = 0;
    int height = 0;
    /// From the camera's position or, orthographic, from the plane through it that the picture is
    /// in, along the ray, in units of length; infinite where there is nothing.
    std::vector<float> depth;
    /// Unit, to shade with, on the side that is seen; 0 where there is nothing.
    std::vector<Vec3f> normal;
    /// In the order of the scene's file, parts of solids one by one; of shapes that are the same,
    /// the first. no_shape where there is nothing.
    std::vector<ShapeId> shape;
    std::vector<MaterialIndex> material; ///< no_material where there is nothing
    std::vector<std::uint32_t> samples;  ///< that the colour is the mean of

    Layers() = default;
    Layers(int width_, int height_) : width(width_), height(height_) {
        const std::size_t count = static_cast<std::size_t>(width) * static_cast<unsigned>(height);
        depth.assign(count, std::numeric_limits<float>::infinity());
        normal.assign(count, Vec3f(0.0F));
        shape.assign(count, no_shape);
        material.assign(count, no_material);
        samples.assign(count, 0);
    }

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<unsigned>(width) +
               static_cast<unsigned>(x);
    }
};

} // namespace raylane::core
