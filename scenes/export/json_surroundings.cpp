#include "scenes/export/json_surroundings.hpp"

#include "core/scene/pattern.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace raylane::scenes {

namespace {

void write_pattern(JsonObject& material, TextFile& file, const core::Pattern& pattern) {
    using core::PatternKind;
    if (pattern.kind == PatternKind::solid) {
        material.vector("color", pattern.colors[0]);
        return;
    }
    material.key("pattern");
    JsonObject object(file);
    if (pattern.kind == PatternKind::back_plane) {
        object.text("type", "back-plane");
        return;
    }
    object.text("type", pattern.kind == PatternKind::checker   ? "checker"
                        : pattern.kind == PatternKind::stripes ? "stripes"
                                                               : "gradient");
    object.vectors("colors", {pattern.colors[0], pattern.colors[1]});
    if (pattern.kind == PatternKind::checker) {
        object.number("size", pattern.size);
        std::string axes, upper_edges;
        for (int axis = 0; axis < 3; ++axis) {
            if ((pattern.axes >> axis & 1) != 0) axes += "xyz"[axis];
            if (core::holds_upper_edge(pattern, axis)) upper_edges += "xyz"[axis];
        }
        object.text("axes", axes);
        if (!upper_edges.empty()) object.text("upper_edges", upper_edges);
    } else if (pattern.kind == PatternKind::stripes) {
        object.number("width", pattern.size);
        object.vector("direction", pattern.direction);
    } else {
        object.vector("from", pattern.from);
        object.vector("to", pattern.to);
    }
}

void write_material(TextFile& file, const core::Material& material) {
    JsonObject object(file);
    write_pattern(object, file, material.pattern);
    object.number("ambient", material.ambient);
    object.number("diffuse", material.diffuse);
    object.number("specular", material.specular);
    object.number("exponent", material.exponent);
    if (material.reflection == core::Reflection::constant)
        object.number("reflectivity", material.reflectivity);
    else
        object.text("reflection",
                    material.reflection == core::Reflection::schlick ? "schlick" : "dielectric");
    object.number("transmission", material.transmission);
    if (material.is_see_through()) object.number("opacity", material.opacity);
    if (material.glass.any()) {
        TextFile& glass = object.key("glass");
        const char* before = "{\"B\": [";
        for (const auto* numbers : {&material.glass.B, &material.glass.C}) {
            glass << before << (*numbers)[0] << ", " << (*numbers)[1] << ", " << (*numbers)[2];
            before = "], \"C\": [";
        }
        glass << "]}";
    } else {
        object.number("index", material.index);
    }
    object.vector("absorption", material.absorption);
    if (material.visible != core::Visible::both)
        object.text("visible", material.visible == core::Visible::outside ? "outside" : "inside");
}

void write_camera(JsonObject& object, const core::Camera& camera) {
    const bool perspective = camera.projection == core::Projection::perspective;
    object.text("type", perspective ? "perspective" : "orthographic");
    object.vector("from", camera.from);
    object.vector("at", camera.at);
    object.vector("up", camera.up);
    if (perspective)
        object.number("field_of_view", camera.field_of_view);
    else
        object.number("height", camera.height);
    if (camera.lens_radius > 0.0F) object.number("lens_radius", camera.lens_radius);
    if (camera.focus_distance > 0.0F) object.number("focus_distance", camera.focus_distance);
}

void write_framing(JsonObject& object, const core::Framing& framing, float depth_cue) {
    const core::Framing usual;
    object.text("type", "auto");
    object.vector("view", framing.direction);
    object.vector("up", framing.up);
    if (framing.zoom != usual.zoom) object.number("zoom", framing.zoom);
    if (framing.projection == core::Projection::orthographic)
        object.key("orthographic") << "true";
    else if (framing.field_of_view != usual.field_of_view)
        object.number("field_of_view", framing.field_of_view);
    if (depth_cue > 0.0F) object.number("depth_cue", depth_cue);
}

} // namespace

void write_settings(JsonObject& root, TextFile& file, const core::Settings& settings) {
    root.key("image");
    {
        JsonObject image(file);
        image.number("width", settings.width);
        image.number("height", settings.height);
        image.text("transfer", settings.transfer == core::Transfer::srgb ? "srgb" : "linear");
        if (settings.alpha) image.key("alpha") << "true";
    }
    root.key("sampling");
    {
        JsonObject sampling(file);
        sampling.number("grid", settings.grid);
        sampling.text("pattern",
                      settings.samples == core::SamplePattern::regular ? "regular" : "stratified");
        if (settings.filter != core::PixelFilter::box)
            sampling.text("filter", settings.filter == core::PixelFilter::gaussian
                                        ? "gaussian"
                                        : "blackman-harris");
        if (settings.light_samples != core::Settings{}.light_samples)
            sampling.number("light_samples", settings.light_samples);
        if (settings.quality != 0.0F) sampling.number("quality", settings.quality);
    }
    root.key("limits");
    {
        JsonObject limits(file);
        limits.number("max_depth", settings.max_depth);
        limits.number("min_weight", settings.min_weight);
        if (settings.max_see_through != core::Settings::see_through_limit)
            limits.number("max_see_through", settings.max_see_through);
    }
    // Keeps the color and creases of a disabled outline, for users who enable it.
    const core::Outline &outline = settings.outline, usual{};
    if (outline.any() || outline.color != usual.color || outline.creases != usual.creases) {
        root.key("outline");
        JsonObject object(file);
        object.number("width", outline.width);
        object.vector("color", outline.color);
        object.number("creases", outline.creases);
    }
}

void write_surroundings(JsonObject& root, TextFile& file, const core::Scene& scene,
                        const core::Staging& staging) {
    root.key("camera");
    {
        JsonObject object(file);
        if (staging.framing)
            write_framing(object, *staging.framing, staging.depth_cue);
        else
            write_camera(object, scene.camera());
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
    if (fog.kind != core::FogKind::none && !(staging.depth_cue > 0.0F)) {
        root.key("fog");
        JsonObject object(file);
        object.text("type", fog.kind == core::FogKind::linear_z ? "linear-z"
                            : fog.kind == core::FogKind::linear ? "linear"
                                                                : "exponential");
        object.vector("color", fog.color);
        if (fog.kind == core::FogKind::exponential) {
            object.number("density", fog.density);
        } else {
            object.number("start", fog.start);
            object.number("end", fog.end);
        }
    }
}

void write_lights(JsonObject& root, TextFile& file, const core::Scene& scene,
                  const core::Staging& staging) {
    root.key("lights") << "[";
    const char* separator = "\n";
    const std::size_t count = staging.lights ? scene.own_light_count() : scene.lights().size();
    for (std::size_t i = 0; i < count; ++i) {
        const core::Light& light = scene.lights()[i];
        file << std::exchange(separator, ",\n");
        JsonObject object(file);
        switch (light.kind) {
        case core::LightKind::point:
            object.text("type", "point");
            object.vector("position", light.position);
            break;
        case core::LightKind::directional:
            object.text("type", "directional");
            object.vector("direction", light.direction);
            break;
        case core::LightKind::sky:
            object.text("type", "sky");
            object.vector("direction", light.direction);
            object.vector("ground", light.ground);
            if (light.reach < std::numeric_limits<float>::infinity())
                object.number("reach", light.reach);
            break;
        case core::LightKind::sphere:
            object.text("type", "sphere");
            object.vector("position", light.position);
            object.number("radius", light.radius);
            break;
        case core::LightKind::disc:
            object.text("type", "disc");
            object.vector("position", light.position);
            object.vector("direction", light.direction);
            object.number("radius", light.radius);
            break;
        case core::LightKind::rectangle:
            object.text("type", "rectangle");
            object.vector("position", light.position);
            object.vector("edge_u", light.edge_u);
            object.vector("edge_v", light.edge_v);
            break;
        }
        object.vector("color", light.color);
    }
    if (staging.lights) file << separator << R"({"type": "camera"})";
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
                     const MaterialNames& names) {
    root.key("materials") << "{";
    const char* separator = "\n";
    for (std::size_t i = 0; i < scene.materials().size(); ++i) {
        file << std::exchange(separator, ",\n") << names[static_cast<core::MaterialIndex>(i)]
             << ": ";
        write_material(file, scene.materials()[i]);
    }
    file << "}";
}

} // namespace raylane::scenes
