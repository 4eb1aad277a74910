#include "scenes/export/json_parts.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

void write_all_but_objects(JsonObject& root, TextFile& file, const core::Scene& scene,
                           const core::AutoCamera& auto_camera, const MaterialNames& names,
                           const std::filesystem::path* folder) {
    write_settings(root, scene.settings());
    write_surroundings(root, scene, auto_camera);
    write_lights(root, file, scene, auto_camera);
    write_materials(root, file, scene, names, folder);
}

bool has_object_spaces(const core::Scene& scene) {
    if (!scene.object_spaces().empty()) return true;
    if (scene.copies() == nullptr) return false;
    return std::any_of(
        scene.materials().begin(), scene.materials().end(),
        [](const core::Material& material) { return material.pattern.follows_objects(); });
}

} // namespace

void write_json(TextFile& file, const core::Scene& scene, Differences& differences,
                const std::filesystem::path& folder) {
    if (has_object_spaces(scene))
        throw core::InvalidValue("", "cannot store patterns that have moved with their objects");
    const core::AutoCamera auto_camera = auto_camera_in_json(scene);
    differences.merge(lost_auto_camera(scene.auto_camera(), auto_camera));
    if (!scene.polygons().empty()) differences.insert(lost_polygons);
    JsonObject root(file, ",\n");
    file << "\n";
    const MaterialNames names = MaterialNames::own(scene);
    write_all_but_objects(root, file, scene, auto_camera, names, &folder);
    write_objects(root, file, scene, names);
}

void write_json_without_objects(TextFile& file, const core::Scene& scene) {
    JsonObject root(file, ",\n");
    file << "\n";
    write_all_but_objects(root, file, scene, {}, MaterialNames::own(scene), nullptr);
    root.key("objects") << "[]";
}

void write_json_settings(TextFile& file, const core::Settings& settings) {
    JsonObject root(file);
    write_settings(root, settings);
}

void write_json_without_shapes(TextFile& file, const core::Scene& scene) {
    JsonObject root(file, ",\n");
    file << "\n";
    const MaterialNames names = MaterialNames::numbers(scene);
    write_surroundings(root, scene, {});
    write_lights(root, file, scene, {});
    write_materials(root, file, scene, names, nullptr);
    write_solids(root, file, scene, names);
}

} // namespace raylane::scenes
