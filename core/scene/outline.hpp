#pragma once

#include "core/scene/material.hpp"

namespace raylane::core {

/// Lines over the image, along the edges of the surfaces that the camera sees first.
struct Outline {
    float width = 0.0F; ///< pixels, at most max_width; 0: no lines
    Color color{0.0F};  ///< linear RGB
    /// Below 180, lines also separate surfaces that meet if they are bent by at least this angle,
    /// in degrees, 0 to 180, or if their materials differ. 180: lines only where one surface is
    /// seen in front of another.
    float creases = 180.0F;

    static constexpr float max_width = 32.0F;

    bool any() const { return width > 0.0F; }
    bool has_creases() const { return creases < 180.0F; }
};

} // namespace raylane::core
