#pragma once

#include "core/numbers/elementary.hpp"
#include "core/numbers/more_functions.hpp"

#include <numbers>

namespace raylane::core {

/// Half of a field of view of one degree, in radians.
inline constexpr double half_degree = std::numbers::pi / 360.0;

/// Returns half of the image's height at distance 1, which is the slope of its upper edge, for a
/// field of view in degrees from the lower to the upper edge.
inline double slope_of_view(double field_of_view) {
    return tan(half_degree * field_of_view);
}
inline double slope_of_view(float field_of_view) {
    return slope_of_view(static_cast<double>(field_of_view));
}

/// Returns the field of view in degrees, as in Camera, for the slope of the image's upper edge.
inline float field_of_view(double slope) {
    return static_cast<float>(atan(slope) / half_degree);
}

} // namespace raylane::core
