#pragma once

#include "core/scene/scene.hpp"
#include "scenes/export/json_object.hpp"

namespace raylane::scenes {

void write_settings(JsonObject& root, TextFile& file, const core::Settings& settings);
/// Camera, background, spectrum and fog. What of it follows from `staging` is left for the reader
/// to find.
void write_surroundings(JsonObject& root, TextFile& file, const core::Scene& scene,
                        const core::Staging& staging);
/// Without those that the camera brings along, if the reader is to find them.
void write_lights(JsonObject& root, TextFile& file, const core::Scene& scene,
                  const core::Staging& staging);
/// Their names are their numbers.
void write_materials(JsonObject& root, TextFile& file, const core::Scene& scene);

} // namespace raylane::scenes
