#pragma once

#include "scenes/export/export.hpp"
#include "scenes/files/errors.hpp"
#include "simd/wavefront/render.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace raylane::tests {

/// Returns the pixels of a small image of a scene, by the scene's settings.
inline std::vector<core::Color> image_of(const core::Scene& scene) {
    core::Settings settings = scene.settings();
    settings.height = 48 * settings.height / settings.width;
    settings.width = 48;
    settings.grid = std::min(settings.grid, 2);
    return simd::render(scene, settings, {}).film.pixels();
}

/// Returns the error of an export, or "" if the scene was written.
inline std::string complaint(const std::filesystem::path& path, const core::Scene& scene) {
    try {
        scenes::export_scene(path, scene);
    } catch (const scenes::BadInput& error) {
        return error.what();
    }
    return "";
}

} // namespace raylane::tests
