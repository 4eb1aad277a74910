#include "core/scene/features.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/files/number.hpp"
#include "scenes/tool/commands/command.hpp"
#include "scenes/tool/loading.hpp"
#include "scenes/tool/options/scene_options.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <vector>

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

/// Returns the least and the largest finite number of a property, or null.
Json range_of(const AtomProperty& property) {
    float least = std::numeric_limits<float>::infinity(), most = -least;
    for (const float number : property.values)
        if (std::isfinite(number)) {
            least = std::min(least, number);
            most = std::max(most, number);
        }
    if (!(least <= most)) return nullptr;
    return {
        {"name", printable(property.name)}, {"min", as_printed(least)}, {"max", as_printed(most)}};
}

/// Returns the words and numbers that selections of atoms can use.
Json atoms_of(const Structure& structure) {
    std::map<std::string, std::size_t> elements, types, chains, residues;
    for (const std::uint16_t index : structure.kinds) {
        const AtomKind& kind = structure.of_kind[index];
        if (kind.element != 0)
            ++elements[std::string(data_of(kind.element).symbol)];
        else
            ++types[kind.label];
    }
    for (const Residue& residue : structure.of_residue) {
        ++residues[residue.name];
        const std::string& chain = structure.chains[residue.chain];
        if (!chain.empty()) ++chains[chain];
    }
    Json numbers = Json::array();
    for (const AtomProperty& property : structure.properties)
        if (const Json range = range_of(property); !range.is_null()) numbers.push_back(range);
    const auto counts = [](const std::map<std::string, std::size_t>& of_name) {
        Json result = Json::object();
        for (const auto& [name, count] : of_name)
            result[printable(name)] = count;
        return result;
    };
    return {{"count", structure.size()}, {"elements", counts(elements)}, {"types", counts(types)},
            {"chains", counts(chains)},  {"residues", counts(residues)}, {"numbers", numbers}};
}

/// `atoms`: the result of atoms_of(), or null for a scene of other shapes.
Json info_of(const std::string& name, const core::Scene& scene, const Json& atoms) {
    const core::Settings& settings = scene.settings();
    const core::Features features = features_of(scene, settings);
    const std::size_t film_bytes =
        static_cast<std::size_t>(settings.width) * settings.height * sizeof(core::Color);
    return {{"scene", printable(name, 4096)},
            {"shapes", shape_counts(scene)},
            {"shape_count", scene.shape_count()},
            {"bounds", bounds_of(scene)},
            {"atoms", atoms},
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

/// Returns texts with commas between them, at most 40.
std::string listed(const std::vector<std::string>& texts) {
    constexpr std::size_t most = 40;
    std::string list;
    for (std::size_t i = 0; i < std::min(texts.size(), most); ++i)
        list.append(i == 0 ? "" : ", ").append(texts[i]);
    if (texts.size() > most) list.append(" and " + std::to_string(texts.size() - most) + " more");
    return list;
}

/// Returns "3 a, 2 b".
std::string counted(const Json& counts) {
    std::vector<std::string> texts;
    for (const auto& [name, count] : counts.items())
        texts.push_back(count.dump() + " " + name);
    return listed(texts);
}

void print_atoms(const Json& atoms) {
    std::vector<std::string> chains, numbers;
    for (const auto& [name, count] : atoms["chains"].items())
        chains.push_back(count.dump() + (count == 1 ? " residue in " : " residues in ") + name);
    for (const Json& number : atoms["numbers"])
        numbers.push_back(number["name"].get<std::string>() + " from " +
                          to_text(number["min"].get<float>()) + " to " +
                          to_text(number["max"].get<float>()));
    const auto line_unless_empty = [](const char* name, const std::string& text) {
        if (!text.empty()) line(name, text);
    };
    line("atoms", atoms["count"].dump());
    line_unless_empty("elements", counted(atoms["elements"]));
    line_unless_empty("types", counted(atoms["types"]));
    line_unless_empty("chains", listed(chains));
    line_unless_empty("residues", counted(atoms["residues"]));
    line_unless_empty("numbers", listed(numbers));
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
    Json atoms; // null
    const core::Scene scene =
        load_seen(*arguments.scene, arguments.scene_arguments, 0,
                  [&](const Structure& structure) { atoms = atoms_of(structure); });
    const Json info = info_of(*arguments.scene, scene, atoms);
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
