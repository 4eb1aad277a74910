#include "scenes/formats/json/material.hpp"

#include "scenes/formats/json/fields.hpp"

#include <algorithm>

namespace raylane::scenes {

namespace {

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
        return core::Pattern{.colors = {core::Color(gray), core::Color(gray)}};
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

void read_field(const JsonValue& value, const core::fields::Field&, core::Pattern& to) {
    to = {.kind = static_cast<core::PatternKind>(
              read_word(value.at("type"), core::fields::pattern_kind))};
    read_only_fields(value, to);
}

/// Reads a glass: its name, or its coefficients.
void read_field(const JsonValue& value, const core::fields::Field&, core::Sellmeier& to) {
    if (value.type() == JsonType::object) {
        read_only_fields(value, to);
        if (!to.any()) value.at("B").fail("must not all be 0");
        return;
    }
    std::vector<std::pair<std::string_view, core::Sellmeier>> glasses;
    for (const core::NamedGlass& named : core::glass_catalogue())
        glasses.emplace_back(named.name, named.glass);
    to = value.choice(JsonValue::Choices<core::Sellmeier>(glasses));
}

core::Material read_material(const JsonValue& value) {
    core::Material material;
    allow_fields(value, material, {"preset", "color"});
    value.exclude("color", "pattern");
    value.exclude("reflectivity", "reflection");
    value.exclude("index", "glass");

    if (const auto preset = value.find("preset")) material = read_preset(*preset);
    if (const auto color = value.find("color")) material.pattern.colors[0] = color->color();
    read_fields(value, material);
    if (value.find("reflectivity")) material.reflection = core::Reflection::constant;
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
