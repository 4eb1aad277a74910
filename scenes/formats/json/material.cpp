#include "scenes/formats/json/material.hpp"

#include "core/scene/presets.hpp"
#include "core/shapes/checks.hpp"
#include "core/solids/object_space.hpp"
#include "scenes/formats/json/fields.hpp"
#include "scenes/formats/json/transform.hpp"

#include <cmath>
#include <span>

namespace raylane::scenes {

namespace {

/// Returns the value with the name that `value` has.
template <class Value, class Named>
Value named(const JsonValue& value, std::span<const Named> table, Value Named::*member) {
    std::vector<std::pair<std::string_view, Value>> choices;
    for (const Named& each : table)
        choices.emplace_back(each.name, each.*member);
    return value.choice(JsonValue::Choices<Value>(choices));
}

/// Returns formulas of the coordinates that a point had before the transform of a pattern moved it
/// to x, y, z.
core::FormulaTexts coordinates_before(const JsonValue& pattern) {
    using core::checks::text_of;
    const core::Transform transform = transform_of(pattern);
    const core::ObjectSpace before = core::space_moved_by(transform.columns(), transform.origin());
    const core::Vec3d& origin = before.origin;
    core::FormulaTexts texts;
    for (int row = 0; row < 3; ++row) {
        for (int axis = 0; axis < 3; ++axis) {
            const double factor = before.rows[static_cast<std::size_t>(row)][axis];
            if (!std::isfinite(factor) || !std::isfinite(origin[axis]))
                pattern.fail(
                    "must have a transform with an inverse whose numbers doubles can hold");
            if (factor == 0.0) continue;
            std::string part(1, "xyz"[axis]);
            if (origin[axis] != 0.0)
                part.insert(0, "(")
                    .append(origin[axis] < 0.0 ? " + " : " - ")
                    .append(text_of(std::abs(origin[axis])))
                    .append(")");
            if (factor != 1.0) part.insert(0, text_of(factor) + " * ");
            texts[row] += (texts[row].empty() ? "" : " + ") + part;
        }
        if (texts[row] == std::string(1, "xyz"[row])) texts[row].clear(); // not moved
    }
    return texts;
}

} // namespace

void read_field(const JsonValue& value, const core::fields::Field&, core::Pattern& to) {
    // Old files have a word for the formula of the wall in birthday.json.
    const std::size_t kind = read_word(value.at("type"), core::fields::pattern_kind, "back-plane");
    to = {};
    if (kind == std::size(core::fields::pattern_words)) {
        value.allow_only({"type"});
        to.kind = core::PatternKind::formula;
        to.formula = core::Formula({"x^2 + y^2 < 150 ? (y > 0 ? 1 : 0.7) : y < 0 ? 0 : abs(cos(x))",
                                    "x^2 + y^2 < 150 ? 0.2 : y < 0 ? 0 : abs(sin(sqrt(y)))",
                                    "x^2 + y^2 < 150 ? 0 : abs(cos(y < 0 ? y : sqrt(y)))"});
        return;
    }
    to.kind = static_cast<core::PatternKind>(kind);
    if (to.kind != core::PatternKind::formula) return read_only_fields(value, to);
    allow_fields(value, to, {"scale", "rotate", "translate", "transform"});
    read_fields(value, to);
    if (has_transform(value)) to.formula = formula_of(value.at("color"), coordinates_before(value));
}

/// Reads a glass: its name, or its coefficients.
void read_field(const JsonValue& value, const core::fields::Field&, core::Sellmeier& to) {
    if (value.type() == JsonType::object) {
        read_only_fields(value, to);
        if (!to.any()) value.at("B").fail("must not all be 0");
        return;
    }
    to = named(value, core::glass_catalogue(), &core::NamedGlass::glass);
}

core::Material read_material(const JsonValue& value) {
    core::Material material;
    allow_fields(value, material, {"preset", "color"});
    value.exclude("color", "pattern");
    value.exclude("reflectivity", "reflection");
    value.exclude("index", "glass");

    // Other keys beside the preset override it.
    if (const auto preset = value.find("preset"))
        material = named(*preset, core::material_presets(), &core::NamedMaterial::material);
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
    static constexpr std::string_view formula = "pattern/formula";
    if (field.starts_with(formula)) return "pattern/color" + field.substr(formula.size());
    return field;
}

} // namespace raylane::scenes
