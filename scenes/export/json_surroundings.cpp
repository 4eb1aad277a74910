#include "core/scene/fields.hpp"
#include "scenes/export/json_parts.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace raylane::scenes {

namespace {

using core::fields::Field;

template <class Of>
void write_fields(JsonObject& object, const Of& source, const char* group = "");

void write_axes(JsonObject& object, const Field& field, std::uint8_t bits) {
    std::string axes;
    for (int axis = 0; axis < 3; ++axis)
        if ((bits >> (axis + field.spelling.first_bit) & 1) != 0) axes += "xyz"[axis];
    if (!axes.empty()) object.text(field.key(), axes);
}

void write_field(JsonObject& object, const Field& field, const core::Pattern& pattern) {
    if (pattern.kind == core::PatternKind::solid) return object.vector("color", pattern.colors[0]);
    JsonObject inner(object.key(field.key()));
    write_fields(inner, pattern);
}

template <class Value>
void write_field(JsonObject& object, const Field& field, const Value& value) {
    if constexpr (std::is_enum_v<Value>) {
        object.text(field.key(), field.valid.words[static_cast<std::size_t>(value)]);
    } else if constexpr (std::is_same_v<Value, std::uint8_t>) {
        write_axes(object, field, value);
    } else if constexpr (std::is_same_v<Value, bool>) {
        object.key(field.key()) << (value ? "true" : "false");
    } else if constexpr (std::is_same_v<Value, core::Vec3f>) {
        object.vector(field.key(), value);
    } else if constexpr (std::is_same_v<Value, core::Texture>) {
        if (value.any()) object.key(field.key()) << nlohmann::json(value.file()).dump();
    } else if constexpr (std::is_same_v<Value, core::Formula>) {
        object.key(field.key()) << nlohmann::json(value.texts()).dump();
    } else if constexpr (std::is_same_v<Value, std::array<core::Color, 2>>) {
        object.vectors(field.key(), {value[0], value[1]});
    } else if constexpr (std::is_same_v<Value, std::array<double, 3>>) {
        object.vector(field.key(), core::Vec3d(value[0], value[1], value[2]));
    } else if constexpr (std::is_arithmetic_v<Value>) {
        object.number(field.key(), value);
    } else {
        JsonObject inner(object.key(field.key()));
        write_fields(inner, value);
    }
}

/// Gives an image the name of its file relative to a folder. Without a folder, removes the image.
void name_image(core::Texture& image, const std::filesystem::path* folder) {
    if (!image.any()) return;
    if (folder == nullptr) {
        image = {};
        return;
    }
    if (image.file().empty())
        throw core::InvalidValue("", "cannot store an image that comes from no file");
    std::error_code none;
    const std::filesystem::path name =
        folder->empty() ? std::filesystem::proximate(image.file(), none)
                        : std::filesystem::proximate(image.file(), *folder, none);
    image = image.named(name.empty() ? image.file() : name.generic_string());
}

/// Returns true if a key of a material is not the alternative to another one.
bool is_wanted(const core::Material& material, std::string_view name) {
    const bool is_constant = material.reflection == core::Reflection::constant;
    return name != (is_constant ? "reflection" : "reflectivity") &&
           name != (material.glass.any() ? "index" : "glass");
}
/// The color of a light comes last.
bool is_wanted(const core::Light&, std::string_view name) {
    return name != "color";
}
bool is_wanted(const auto&, std::string_view) {
    return true;
}

/// Writes the fields of a struct's kind. `group`: only fields of this group.
template <class Of>
void write_fields(JsonObject& object, const Of& source, const char* group) {
    const Of usual{};
    core::fields::for_each_field(
        [&, kind = core::fields::kind_of(source)]<class Value>(
            const Field& field, const Value& value, const Value& usual_value) {
            if (!field.is_in(group, kind) || !is_wanted(source, field.name)) return;
            if constexpr (std::equality_comparable<Value>)
                if (field.spelling.sparse && value == usual_value) return;
            write_field(object, field, value);
        },
        source, usual);
}

void write_fit_camera(JsonObject& object, const core::FitCamera& fit_camera, float depth_cue) {
    const core::FitCamera usual;
    object.text("type", "auto");
    object.vector("view", fit_camera.direction);
    object.vector("up", fit_camera.up);
    if (fit_camera.zoom != usual.zoom) object.number("zoom", fit_camera.zoom);
    if (fit_camera.projection == core::Projection::orthographic)
        object.key("orthographic") << "true";
    else if (fit_camera.field_of_view != usual.field_of_view)
        object.number("field_of_view", fit_camera.field_of_view);
    if (depth_cue > 0.0F) object.number("depth_cue", depth_cue);
}

} // namespace

void write_settings(JsonObject& root, const core::Settings& settings) {
    for (const char* group : {"image", "sampling", "limits"}) {
        JsonObject object(root.key(group));
        write_fields(object, settings, group);
    }
    // Keeps the color and creases of a disabled outline, for users who enable it.
    const core::Outline &outline = settings.outline, usual{};
    if (outline.any() || outline.color != usual.color || outline.creases != usual.creases) {
        JsonObject object(root.key("outline"));
        write_fields(object, outline);
    }
}

void write_surroundings(JsonObject& root, const core::Scene& scene,
                        const core::AutoCamera& auto_camera) {
    {
        JsonObject object(root.key("camera"));
        if (auto_camera.fit_camera)
            write_fit_camera(object, *auto_camera.fit_camera, auto_camera.depth_cue);
        else
            write_fields(object, scene.camera());
    }
    root.vector("background", scene.background());
    if (!scene.wavelengths().empty()) {
        TextFile& list = root.key("spectrum");
        const char* before = "{\"wavelengths\": [";
        for (const double wavelength : scene.wavelengths())
            list << std::exchange(before, ", ") << wavelength;
        list << "]}";
    }
    const core::Fog& fog = scene.fog();
    if (fog.kind != core::FogKind::none && !(auto_camera.depth_cue > 0.0F)) {
        JsonObject object(root.key("fog"));
        write_fields(object, fog);
    }
}

void write_lights(JsonObject& root, TextFile& file, const core::Scene& scene,
                  const core::AutoCamera& auto_camera) {
    root.key("lights") << "[";
    const char* separator = "\n";
    const std::size_t count = auto_camera.lights ? scene.own_light_count() : scene.lights().size();
    for (std::size_t i = 0; i < count; ++i) {
        const core::Light& light = scene.lights()[i];
        file << std::exchange(separator, ",\n");
        JsonObject object(file);
        write_fields(object, light);
        object.vector("color", light.color);
    }
    if (auto_camera.lights) file << separator << R"({"type": "camera"})";
    file << "]";
}

MaterialNames MaterialNames::own(const core::Scene& scene) {
    MaterialNames names;
    names.names_.resize(scene.materials().size());
    std::set<std::string> taken;
    std::map<std::string, std::size_t> last; // last suffix of a name that materials share
    const auto take = [&](std::size_t index, const std::string& wanted) {
        std::string name = wanted;
        while (!taken.insert(name).second)
            name = wanted + '-' + std::to_string(++last.try_emplace(wanted, 1).first->second);
        names.names_[index] = '"' + name + '"';
    };
    const auto name_of = [&](std::size_t index) {
        return scene.material_name(static_cast<core::MaterialIndex>(index));
    };
    for (std::size_t i = 0; i < names.names_.size(); ++i) {
        if (name_of(i).empty()) continue;
        const std::string quoted =
            nlohmann::json(name_of(i))
                .dump(-1, ' ', false,
                      nlohmann::json::error_handler_t::replace); // bytes that are not UTF-8
        take(i, quoted.substr(1, quoted.size() - 2));
    }
    for (std::size_t i = 0; i < names.names_.size(); ++i)
        if (name_of(i).empty()) take(i, std::to_string(i));
    return names;
}

MaterialNames MaterialNames::numbers(const core::Scene& scene) {
    MaterialNames names;
    for (std::size_t i = 0; i < scene.materials().size(); ++i)
        names.names_.push_back('"' + std::to_string(i) + '"');
    return names;
}

void write_materials(JsonObject& root, TextFile& file, const core::Scene& scene,
                     const MaterialNames& names, const std::filesystem::path* folder) {
    root.key("materials") << "{";
    const char* separator = "\n";
    for (std::size_t i = 0; i < scene.materials().size(); ++i) {
        file << std::exchange(separator, ",\n") << names[static_cast<core::MaterialIndex>(i)]
             << ": ";
        core::Material material = scene.materials()[i];
        name_image(material.pattern.image, folder);
        JsonObject object(file);
        write_fields(object, material);
    }
    file << "}";
}

} // namespace raylane::scenes
