#pragma once

#include "tests/catch.hpp"
#include "tests/places.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace raylane::tests {

/// The path of a scene that is not the project's to ship. Without, a test skips itself; it has been
/// said why.
inline std::optional<std::filesystem::path> shared_scene(const std::string& name) {
    std::filesystem::path path = RAYLANE_SHARED_SCENES "/" + name;
    if (std::filesystem::exists(path)) return path;
    WARN("skipped: no " << path);
    return std::nullopt;
}

} // namespace raylane::tests
