#pragma once

#include "core/scene/material.hpp"

namespace raylane::core {

/// Lines along the edges of what the camera sees first, over the picture.
struct Outline {
    float width = 0.0F; ///< pixels, at most max_width; 0: none
    Color color{0.0F};  ///< linear RGB
    /// Degrees, 0 to 180, that surfaces which meet are bent by at least where there is a line
    /// between them; there is one between two materials, too. 180: there are none where surfaces
    /// meet, only where one is seen before another.
    float creases = 180.0F;

    static constexpr float max_width = 32.0F;

    bool any() const { return width > 0.0F; }
    bool has_creases() const { return creases < 180.0F; }
};

} // namespace raylane::core
