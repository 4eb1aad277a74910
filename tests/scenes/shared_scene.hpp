#pragma once

#include "tests/catch.hpp"
#include "tests/places.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace raylane::tests {

/// Returns the path of a scene that the project may not ship. If it is missing, warns and returns
/// nothing, and the test skips itself.
inline std::optional<std::filesystem::path> shared_scene(const std::string& name) {
    std::filesystem::path path = RAYLANE_SHARED_SCENES "/" + name;
    if (std::filesystem::exists(path)) return path;
    WARN("skipped: no " << path);
    return std::nullopt;
}

} // namespace raylane::tests
