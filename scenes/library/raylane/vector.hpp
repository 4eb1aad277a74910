#pragma once

#include "raylane/api.h"

namespace RAYLANE_API raylane {

/// A point, a direction or, as red, green and blue, a colour.
struct Vec3 {
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F;

    friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// Linear RGB; 1 is the picture's white.
using Color = Vec3;

} // namespace raylane
