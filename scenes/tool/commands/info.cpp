#include "core/scene/features.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/scene_options.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace raylane::scenes {

namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments : OptionTable {
    Option<std::string> scene = {*this, "SCENE", file_argument(), any_scene};
    Flag json = {*this, "--json", flag(), "Print JSON."};
    SceneArguments scene_arguments{*this};
};

const char* text_of(core::FogKind kind) {
    switch (kind) {
    case core::FogKind::none:
        break;
    case core::FogKind::linear_z:
        return "linear-z";
    case core::FogKind::linear:
        return "linear";
    case core::FogKind::exponential:
        return "exponential";
    }
    return "none";
}

Json shape_counts(const core::Scene& scene) {
    Json counts = Json::object();
    core::for_each_table(scene.shapes(), [&]<class Shape>(const core::Table<Shape>& table) {
        std::size_t count = table.size();
        if (scene.copies() != nullptr)
            for (const core::Copies::Set& set : scene.copies()->sets())
                count +=
                    set.copy_count * std::get<core::Table<Shape>>(set.prototype->shapes()).size();
        if (count > 0) counts[std::string(name_of(core::kind_of<Shape>))] = count;
    });
    return counts;
}

/// Returns the bounds of all shapes but planes, or null for planes alone.
Json bounds_of(const core::Scene& scene) {
    core::Bounds bounds = scene.hierarchy().bounds;
    if (scene.copies() != nullptr) bounds.include(scene.copies()->bounds());
    if (!(bounds.lower.x <= bounds.upper.x)) return nullptr;
    Json lower, upper;
    for (int axis = 0; axis < 3; ++axis) {
        lower.push_back(as_printed(bounds.lower[axis]));
        upper.push_back(as_printed(bounds.upper[axis]));
    }
    return {{"lower", lower}, {"upper", upper}};
}

Json names_where(const core::Features& features, bool wanted) {
    Json names = Json::array();
    for (const auto& [name, needed] : features.named())
        if (needed == wanted) names.push_back(name);
    return names;
}

Json info_of(const std::string& name, const core::Scene& scene) {
    const core::Settings& settings = scene.settings();
    const core::Features features = features_of(scene, settings);
    const std::size_t film_bytes =
        static_cast<std::size_t>(settings.width) * settings.height * sizeof(core::Color);
    return {{"scene", printable(name, 4096)},
            {"shapes", shape_counts(scene)},
            {"shape_count", scene.shape_count()},
            {"bounds", bounds_of(scene)},
            {"materials", scene.materials().size()},
            {"lights", scene.lights().size()},
            {"fog", text_of(scene.fog().kind)},
            {"camera", scene.camera().projection == core::Projection::perspective ? "perspective"
                                                                                  : "orthographic"},
            {"width", settings.width},
            {"height", settings.height},
            {"samples_per_pixel", settings.grid * settings.grid},
            {"quality", as_printed(settings.quality)},
            {"max_depth", settings.max_depth},
            {"min_weight", as_printed(settings.min_weight)},
            {"max_transparent", settings.max_transparent},
            {"transfer", settings.transfer == core::Transfer::srgb ? "srgb" : "linear"},
            {"hierarchy_nodes", scene.hierarchy().nodes.size()},
            {"needed", names_where(features, true)},
            {"left_out", names_where(features, false)},
            {"scene_bytes", scene.bytes()},
            {"double_bytes", scene.double_bytes()},
            {"film_bytes", film_bytes}};
}

std::string joined(const Json& names) {
    std::string text;
    for (const auto& name : names)
        text.append(text.empty() ? "" : ", ").append(name.get<std::string>());
    return text.empty() ? "nothing" : text;
}

std::string bytes_text(double bytes) {
    const char* unit = "bytes";
    for (const char* larger : {"KiB", "MiB", "GiB"}) {
        if (bytes < 1024.0) break;
        bytes /= 1024.0;
        unit = larger;
    }
    char text[64];
    std::snprintf(text, sizeof text, unit[0] == 'b' ? "%.0f %s" : "%.1f %s", bytes, unit);
    return text;
}

void print(const Json& info) {
    const auto line = [](const char* name, const std::string& value) {
        std::printf("%-10s %s\n", name, value.c_str());
    };
    const auto number = [&](const char* key) { return info[key].dump(); };
    std::string shapes = number("shape_count");
    std::string kinds;
    for (const auto& [kind, count] : info["shapes"].items())
        kinds.append(kinds.empty() ? ": " : ", ").append(count.dump() + " " + kind);
    line("shapes", shapes + kinds);
    if (const Json& bounds = info["bounds"]; !bounds.is_null()) {
        std::string extent;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            char text[96];
            std::snprintf(text, sizeof text, "%s%c from %.4g to %.4g", axis == 0 ? "" : ", ",
                          "xyz"[axis], bounds["lower"][axis].get<double>(),
                          bounds["upper"][axis].get<double>());
            extent += text;
        }
        line("extent", extent);
    }
    line("materials", number("materials"));
    line("lights", number("lights"));
    line("fog", info["fog"]);
    line("camera", info["camera"]);
    line("image", number("width") + " x " + number("height") + " pixels, " +
                      (info["quality"] == 0 ? number("samples_per_pixel") + " samples each, "
                                            : number("quality") + " dB, ") +
                      info["transfer"].get<std::string>() + " transfer");
    const bool has_limit = info["max_transparent"] < core::Settings::transparent_limit;
    line("limits",
         "depth " + number("max_depth") + ", weight " + number("min_weight") +
             (has_limit ? ", " + number("max_transparent") + " transparent surfaces" : ""));
    line("needs", joined(info["needed"]));
    line("left out", joined(info["left_out"]));
    const std::string doubles =
        info["double_bytes"] == 0 ? "" : " and " + bytes_text(info["double_bytes"]) + " of doubles";
    line("memory", bytes_text(info["scene_bytes"]) + " scene with " + number("hierarchy_nodes") +
                       " hierarchy nodes" + doubles + ", " + bytes_text(info["film_bytes"]) +
                       " framebuffer");
}

int info(const InfoArguments& arguments) {
    const Json info =
        info_of(*arguments.scene, load_seen(*arguments.scene, arguments.scene_arguments));
    if (arguments.json)
        std::printf("%s\n", info.dump(2).c_str());
    else
        print(info);
    return 0;
}

} // namespace

Command add_info_command(CLI::App& app) {
    return add_command<InfoArguments>(app,
                                      {.name = "info",
                                       .help = "Print the contents and needed features of a scene",
                                       .example = "raylane info scenes/birthday.json"},
                                      info);
}

} // namespace raylane::scenes
