#pragma once

#include "core/scene/scene.hpp"
#include "scenes/export/json_object.hpp"

#include <string>
#include <vector>

namespace raylane::scenes {

void write_settings(JsonObject& root, TextFile& file, const core::Settings& settings);
/// Camera, background, spectrum and fog. What of it follows from `staging` is left for the reader
/// to find.
void write_surroundings(JsonObject& root, TextFile& file, const core::Scene& scene,
                        const core::Staging& staging);
/// Without those that the camera brings along, if the reader is to find them.
void write_lights(JsonObject& root, TextFile& file, const core::Scene& scene,
                  const core::Staging& staging);
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
