#pragma once

#include "core/scene/surroundings.hpp"

#include <algorithm>

namespace raylane::tests {

/// Returns the settings of an image of at most `longest` pixels a side: both sides are divided by
/// one whole number.
inline core::Settings scaled_down(core::Settings settings, int longest) {
    const int divisor = (std::max(settings.width, settings.height) + longest - 1) / longest;
    settings.width /= divisor;
    settings.height /= divisor;
    return settings;
}

} // namespace raylane::tests
