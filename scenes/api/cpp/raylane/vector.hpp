#pragma once

#include "raylane/api.hpp"

#include <string_view>

namespace RAYLANE_API raylane {

/// A point, a direction or a colour (red, green, blue), in float or double.
template <class Number>
struct Vec3Of {
    Number x = 0;
    Number y = 0;
    Number z = 0;

    friend bool operator==(const Vec3Of&, const Vec3Of&) = default;
};
using Vec3 = Vec3Of<float>;

/// Linear RGB; 1 is the image's white.
using Color = Vec3;

/// Returns the linear colour of "#rrggbb", six hexadecimal digits of the sRGB curve. Throws
/// InvalidValue, field "color", for another text.
RAYLANE_API Color color_from_srgb(std::string_view text);

} // namespace raylane
