#include "scenes/json/material.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

using core::Pattern;
using core::PatternKind;

void read_colors(const JsonValue& value, Pattern& pattern) {
    const std::vector<JsonValue> colors = value.at("colors").array(2, "colors");
    pattern.colors = {colors[0].color(), colors[1].color()};
}

std::uint8_t axes_of(const JsonValue& value) {
    static constexpr std::uint8_t x = 1, y = 2, z = 4;
    return value.choice<std::uint8_t>({{"x", x},
                                       {"y", y},
                                       {"z", z},
                                       {"xy", x | y},
                                       {"xz", x | z},
                                       {"yz", y | z},
                                       {"xyz", x | y | z}});
}

Pattern read_checker(const JsonValue& value) {
    value.allow_only({"type", "colors", "size", "axes", "upper_edges"});
    Pattern pattern{.kind = PatternKind::checker};
    read_colors(value, pattern);
    pattern.size = value.at("size").number();
    if (const auto axes = value.find("axes")) pattern.axes = axes_of(*axes);
    if (const auto axes = value.find("upper_edges"))
        pattern.axes = static_cast<std::uint8_t>(pattern.axes | axes_of(*axes) << 3);
    return pattern;
}

Pattern read_stripes(const JsonValue& value) {
    value.allow_only({"type", "colors", "width", "direction"});
    Pattern pattern{.kind = PatternKind::stripes};
    read_colors(value, pattern);
    pattern.size = value.at("width").number();
    if (const auto direction = value.find("direction")) pattern.direction = direction->vector();
    return pattern;
}

Pattern read_gradient(const JsonValue& value) {
    value.allow_only({"type", "colors", "from", "to"});
    Pattern pattern{.kind = PatternKind::gradient};
    read_colors(value, pattern);
    pattern.from = value.at("from").vector();
    pattern.to = value.at("to").vector();
    return pattern;
}

Pattern read_back_plane(const JsonValue& value) {
    value.allow_only({"type"});
    return {.kind = PatternKind::back_plane};
}

Pattern read_pattern(const JsonValue& value) {
    using Read = Pattern (*)(const JsonValue&);
    const Read read = value.at("type").choice<Read>({{"checker", read_checker},
                                                     {"stripes", read_stripes},
                                                     {"gradient", read_gradient},
                                                     {"back-plane", read_back_plane}});
    return read(value);
}

/// Reads a glass: its name, or its coefficients.
core::Sellmeier read_glass(const JsonValue& value) {
    if (value.type() == JsonType::object) {
        value.allow_only({"B", "C"});
        core::Sellmeier glass;
        for (const auto& [key, numbers] : {std::pair{"B", &glass.B}, std::pair{"C", &glass.C}}) {
            const std::vector<JsonValue> values = value.at(key).array(3, "numbers");
            for (std::size_t i = 0; i < 3; ++i)
                (*numbers)[i] = values[i].real();
        }
        if (!glass.any()) value.at("B").fail("must not all be 0");
        return glass;
    }
    std::vector<std::pair<std::string_view, core::Sellmeier>> glasses;
    for (const core::NamedGlass& named : core::glass_catalogue())
        glasses.emplace_back(named.name, named.glass);
    return value.choice(JsonValue::Choices<core::Sellmeier>(glasses));
}

/// Returns a clear material with this index of refraction.
core::Material clear(float index) {
    return {.pattern = {.colors = {core::Color(0.0F), core::Color(0.0F)}},
            .reflection = core::Reflection::dielectric,
            .transmission = 1.0F,
            .index = index};
}

/// Returns the material of a preset. Other keys beside the preset override it.
core::Material read_preset(const JsonValue& value) {
    using core::Material;
    const auto of_color = [](float gray) {
        return Pattern{.colors = {core::Color(gray), core::Color(gray)}};
    };
    return value.choice<Material>({
        {"matte", Material{}},
        {"plastic", Material{.pattern = {},
                             .specular = 0.3F,
                             .exponent = 60.0F,
                             .reflection = core::Reflection::dielectric}},
        {"metal", Material{.pattern = of_color(0.7F),
                           .diffuse = 0.4F,
                           .specular = 0.6F,
                           .exponent = 80.0F,
                           .reflectivity = 0.35F}},
        {"mirror", Material{.pattern = of_color(0.0F), .reflectivity = 0.95F}},
        {"glass", clear(1.5F)},
        {"water", clear(1.33F)},
        {"diamond", clear(2.42F)},
    });
}

} // namespace

core::Material read_material(const JsonValue& value) {
    value.allow_only({"preset", "color", "pattern", "ambient", "diffuse", "specular", "exponent",
                      "reflectivity", "reflection", "transmission", "index", "glass", "absorption",
                      "opacity", "visible"});
    value.exclude("color", "pattern");
    value.exclude("reflectivity", "reflection");
    value.exclude("index", "glass");

    core::Material material;
    if (const auto preset = value.find("preset")) material = read_preset(*preset);
    if (const auto color = value.find("color")) material.pattern.colors[0] = color->color();
    if (const auto pattern = value.find("pattern")) material.pattern = read_pattern(*pattern);
    const std::initializer_list<std::pair<std::string_view, float*>> numbers = {
        {"ambient", &material.ambient},           {"diffuse", &material.diffuse},
        {"specular", &material.specular},         {"exponent", &material.exponent},
        {"reflectivity", &material.reflectivity}, {"transmission", &material.transmission},
        {"opacity", &material.opacity},           {"index", &material.index}};
    for (const auto& [key, number] : numbers)
        if (const auto found = value.find(key)) *number = found->number();
    if (value.find("reflectivity")) material.reflection = core::Reflection::constant;
    if (const auto reflection = value.find("reflection"))
        material.reflection = reflection->choice<core::Reflection>(
            {{"schlick", core::Reflection::schlick}, {"dielectric", core::Reflection::dielectric}});
    if (const auto glass = value.find("glass")) material.glass = read_glass(*glass);
    if (const auto absorption = value.find("absorption"))
        material.absorption = absorption->vector();
    if (const auto visible = value.find("visible"))
        material.visible = visible->choice<core::Visible>({{"both", core::Visible::both},
                                                           {"outside", core::Visible::outside},
                                                           {"inside", core::Visible::inside}});
    return material;
}

std::string key_of_material_field(const std::string& field, core::PatternKind pattern) {
    static constexpr std::string_view first_color = "pattern/colors/0";
    if (pattern == core::PatternKind::solid && field.starts_with(first_color))
        return "color" + field.substr(first_color.size());
    if (pattern == core::PatternKind::stripes && field == "pattern/size") return "pattern/width";
    return field;
}

} // namespace raylane::scenes
