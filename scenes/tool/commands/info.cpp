#include "core/scene/features.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/scene_options.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <map>

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

/// Returns the words and numbers that selections of atoms can use, or null without atoms.
Json atoms_of(const Structure& structure) {
    if (structure.size() == 0) return nullptr;
    std::map<std::string, std::size_t> elements, chains, residues;
    for (const std::uint16_t index : structure.kinds) {
        const AtomKind& kind = structure.of_kind[index];
        ++elements[kind.element != 0 ? std::string(data_of(kind.element).symbol) : kind.label];
    }
    for (const Residue& residue : structure.of_residue) {
        ++residues[residue.name];
        ++chains[structure.chains[residue.chain]];
    }
    Json numbers = Json::array();
    for (const AtomProperty& property : structure.properties) {
        const auto [least, most] =
            std::minmax_element(property.values.begin(), property.values.end());
        numbers.push_back({{"name", printable(property.name)},
                           {"min", as_printed(*least)},
                           {"max", as_printed(*most)}});
    }
    const auto counts = [](const std::map<std::string, std::size_t>& of_name) {
        Json result = Json::object();
        for (const auto& [name, count] : of_name)
            result[printable(name)] = count;
        return result;
    };
    return {{"count", structure.size()},
            {"elements", counts(elements)},
            {"chains", counts(chains)},
            {"residues", counts(residues)},
            {"numbers", numbers}};
}

Json info_of(const std::string& name, const core::Scene& scene, const Structure& structure) {
    const core::Settings& settings = scene.settings();
    const core::Features features = features_of(scene, settings);
    const std::size_t film_bytes =
        static_cast<std::size_t>(settings.width) * settings.height * sizeof(core::Color);
    return {{"scene", printable(name, 4096)},
            {"shapes", shape_counts(scene)},
            {"shape_count", scene.shape_count()},
            {"bounds", bounds_of(scene)},
            {"atoms", atoms_of(structure)},
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

void line(const char* name, const std::string& value) {
    std::printf("%-10s %s\n", name, value.c_str());
}

/// Returns "3 a, 2 b".
std::string counted(const Json& counts) {
    std::string text;
    for (const auto& [name, count] : counts.items())
        text.append(text.empty() ? "" : ", ").append(count.dump() + " " + name);
    return text;
}

void print_atoms(const Json& atoms) {
    line("atoms", atoms["count"].dump() + ": " + counted(atoms["elements"]));
    std::string chains, numbers;
    for (const auto& [name, count] : atoms["chains"].items())
        chains.append(chains.empty() ? "" : ", ")
            .append(count.dump() + (count == 1 ? " residue in " : " residues in ") + name);
    for (const Json& number : atoms["numbers"])
        numbers.append(numbers.empty() ? "" : ", ")
            .append(number["name"].get<std::string>() + " from " + number["min"].dump() + " to " +
                    number["max"].dump());
    if (!chains.empty()) line("chains", chains);
    if (!atoms["residues"].empty()) line("residues", counted(atoms["residues"]));
    if (!numbers.empty()) line("numbers", numbers);
}

void print(const Json& info) {
    const auto number = [&](const char* key) { return info[key].dump(); };
    const std::string kinds = counted(info["shapes"]);
    line("shapes", number("shape_count") + (kinds.empty() ? "" : ": " + kinds));
    if (!info["atoms"].is_null()) print_atoms(info["atoms"]);
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
    Legend legend;
    const core::Scene scene = load_seen(*arguments.scene, arguments.scene_arguments, 0, &legend);
    const Json info = info_of(*arguments.scene, scene, legend.structure);
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
