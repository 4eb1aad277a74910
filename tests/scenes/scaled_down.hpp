#pragma once

#include "core/scene/surroundings.hpp"

#include <algorithm>

namespace raylane::tests {

/// A picture of no more than `longest` pixels a side, in whole parts of the one wanted.
inline core::Settings scaled_down(core::Settings settings, int longest) {
    const int divisor = (std::max(settings.width, settings.height) + longest - 1) / longest;
    settings.width /= divisor;
    settings.height /= divisor;
    return settings;
}

} // namespace raylane::tests
