#pragma once

#include "core/scene/auto_camera.hpp"
#include "core/scene/scene.hpp"
#include "scenes/export/writers.hpp"

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The parts of a scene in JSON.
namespace raylane::scenes {

/// Writes objects, one key after the other.
class JsonObject {
  public:
    explicit JsonObject(TextFile& file, const char* separator = ", ")
        : file_(file), separator_(separator) {
        file_ << "{";
    }
    ~JsonObject() { file_ << "}"; }
    JsonObject(const JsonObject&) = delete;
    JsonObject& operator=(const JsonObject&) = delete;

    TextFile& key(std::string_view name) {
        if (!std::exchange(first_, false)) file_ << separator_;
        return file_ << "\"" << name << "\": ";
    }
    void text(std::string_view name, std::string_view value) { key(name) << "\"" << value << "\""; }
    void number(std::string_view name, auto value) { key(name) << value; }
    template <class Real>
    void vector(std::string_view name, const core::Vec3<Real>& value) {
        key(name) << "[";
        file_.list(value, ", ") << "]";
    }
    template <class Real>
    void vectors(std::string_view name, std::initializer_list<core::Vec3<Real>> values) {
        key(name) << "[";
        bool first = true;
        for (const core::Vec3<Real>& value : values) {
            file_ << (std::exchange(first, false) ? "[" : ", [");
            file_.list(value, ", ") << "]";
        }
        file_ << "]";
    }

  private:
    TextFile& file_;
    const char* separator_;
    bool first_ = true;
};

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

/// Writes all materials. `folder`: that of the file, to which the names of images are relative;
/// null: without images. Throws core::InvalidValue for an image that comes from no file.
void write_materials(JsonObject& root, TextFile& file, const core::Scene& scene,
                     const MaterialNames& names, const std::filesystem::path* folder);

/// Writes all shapes, in the order of their ids. Throws core::InvalidValue for a solid that is
/// nested deeper than the reader accepts.
void write_objects(JsonObject& root, TextFile& file, const core::Scene& scene,
                   const MaterialNames& names);
/// Writes only constructed solids.
void write_solids(JsonObject& root, TextFile& file, const core::Scene& scene,
                  const MaterialNames& names);

/// Returns the part of a scene's automatic camera that JSON can express, and from which a reader
/// derives the scene's camera, fog and lights, to the bit.
core::AutoCamera auto_camera_in_json(const core::Scene& scene);

/// Returns a phrase for each part of `auto_camera` that is missing in `said`.
Differences lost_auto_camera(const core::AutoCamera& auto_camera, const core::AutoCamera& said);

} // namespace raylane::scenes
