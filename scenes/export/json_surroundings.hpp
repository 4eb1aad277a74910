#pragma once

#include "core/scene/scene.hpp"
#include "scenes/export/json_object.hpp"

#include <string>
#include <vector>

namespace raylane::scenes {

void write_settings(JsonObject& root, const core::Settings& settings);
/// Writes camera, background, spectrum and fog. If camera and fog follow from `auto_camera`, writes
/// the automatic camera instead, from which the reader derives them.
void write_surroundings(JsonObject& root, const core::Scene& scene,
                        const core::AutoCamera& auto_camera);
/// Writes the lights. If `auto_camera` has the camera's own lights, omits these for the reader to
/// add.
void write_lights(JsonObject& root, TextFile& file, const core::Scene& scene,
                  const core::AutoCamera& auto_camera);
/// The names of materials in a JSON file, quoted. All differ.
class MaterialNames {
  public:
    /// Each material's name. A material without a name gets its number. The second material with
    /// one name gets NAME-2.
    static MaterialNames own(const core::Scene& scene);
    static MaterialNames numbers(const core::Scene& scene);

    const std::string& operator[](core::MaterialIndex material) const { return names_[material]; }

  private:
    std::vector<std::string> names_;
};

void write_materials(JsonObject& root, TextFile& file, const core::Scene& scene,
                     const MaterialNames& names);

} // namespace raylane::scenes
