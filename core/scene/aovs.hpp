#pragma once

#include "core/scene/region.hpp"
#include "core/shapes/shape.hpp"
#include "core/solids/solid.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace raylane::core {

/// Render outputs of an image besides its colours (AOVs). Each pixel describes the first visible
/// surface, transmissive or not, on the ray through the pixel's middle and the middle of the lens.
/// Arrays by pixel, rows from top to bottom.
struct Aovs {
    int width = 0;
    int height = 0;
    /// Distance along the ray, in units of length, from the camera's position or, if orthographic,
    /// from the image plane through that position. Infinite where the ray hits nothing.
    std::vector<float> depth;
    /// Unit shading normal, on the visible side; 0 where the ray hits nothing.
    std::vector<Vec3f> normal;
    /// Ids in the order of the scene's file; each part of a solid has one. Equal shapes have the id
    /// of the first. no_shape where the ray hits nothing.
    std::vector<ShapeId> shape;
    std::vector<MaterialIndex> material; ///< no_material where the ray hits nothing
    std::vector<std::uint32_t> samples;  ///< number of samples in the colour's mean

    Aovs() = default;
    Aovs(int width_, int height_) : width(width_), height(height_) {
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
