#pragma once

#include "core/scene/surroundings.hpp"
#include "tests/places.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

namespace raylane::tests {

/// Returns the settings of an image of at most `longest` pixels a side: both sides are divided by
/// one whole number.
inline core::Settings scaled_down(core::Settings settings, int longest) {
    const int divisor = (std::max(settings.width, settings.height) + longest - 1) / longest;
    settings.width /= divisor;
    settings.height /= divisor;
    return settings;
}

/// Returns the path of a scene that the project may not ship. If it is missing, warns and returns
/// nothing, and the test skips itself.
inline std::optional<std::filesystem::path> shared_scene(const std::string& name) {
    std::filesystem::path path = RAYLANE_SHARED_SCENES "/" + name;
    if (std::filesystem::exists(path)) return path;
    WARN("skipped: no " << path);
    return std::nullopt;
}

} // namespace raylane::tests
