#include "scenes/json/reader.hpp"

#include "core/scene/validate.hpp"
#include "scenes/errors.hpp"
#include "scenes/json/items.hpp"
#include "scenes/json/material.hpp"
#include "scenes/json/object.hpp"
#include "scenes/json/surroundings.hpp"

#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

/// Key in the file for a field of core::Material: to core a plain colour is a pattern, too.
std::string key_of_material_field(const std::string& field, core::PatternKind pattern) {
    static constexpr std::string_view first_color = "pattern/colors/0";
    if (pattern == core::PatternKind::solid && field.starts_with(first_color))
        return "color" + field.substr(first_color.size());
    if (pattern == core::PatternKind::stripes && field == "pattern/size") return "pattern/width";
    return field;
}

/// Collects a scene from the items of its file.
class SceneReader {
  public:
    SceneReader(std::string_view file, core::Workers* workers) : file_(file) {
        builder_.workers = workers;
    }

    /// Throws BadInput for what is wrong with the item, and is good for others after that.
    void take(const RootKey& key, std::string_view name, const JsonDocument& item);
    /// Throws BadInput for `errors` and what is wrong with the scene as a whole.
    core::Scene finish(const Outline& outline, InputErrors& errors);

    static constexpr std::array<RootKey, 13> keys = {{
        {"$schema", Holds::one_item},
        {"image", Holds::one_item},
        {"sampling", Holds::one_item},
        {"limits", Holds::one_item},
        {"outline", Holds::one_item},
        {"camera", Holds::one_item, true},
        {"background", Holds::one_item},
        {"fog", Holds::one_item},
        {"spectrum", Holds::one_item},
        {"lights", Holds::item_list},
        {"materials", Holds::named_items},
        {"definitions", Holds::named_items, false, Items::nested},
        {"objects", Holds::item_list, true, Items::nested},
    }};

  private:
    /// A name that came before its material, or has none: where it was used first, and the index
    /// that it has until the material comes.
    struct UnknownName {
        core::MaterialIndex index;
        TextPosition position;
        std::string pointer;
        bool reported;
    };

    void take_settings(const JsonValue& value, void (*read)(const JsonValue&, core::Settings&));
    void take_outline(const JsonValue& value);
    void take_camera(const JsonValue& value);
    void take_background(const JsonValue& value);
    void take_fog(const JsonValue& value);
    void take_spectrum(const JsonValue& value);
    void take_light(const JsonValue& value);
    void take_material(std::string_view name, const JsonValue& value);
    void take_definition(std::string_view name, const JsonValue& value);
    void take_object(const JsonValue& value);

    core::MaterialIndex add(const core::Material& material) {
        ++material_count_;
        return builder_.add_material(material);
    }
    core::MaterialIndex add_material(const JsonValue& value);
    core::MaterialIndex material_of(const JsonValue& value);
    core::MaterialIndex index_of_unknown(const JsonValue& value);
    std::string complaint_about_name(std::string_view name) const;
    void number_materials();
    InputError error_in_scene(const core::InvalidValue& invalid, const Outline& outline) const;

    std::string_view file_;
    core::SceneBuilder builder_;
    std::map<std::string, core::MaterialIndex, std::less<>> materials_;
    std::map<std::string, UnknownName, std::less<>> unknown_names_;
    Definitions definitions_;
    std::vector<core::MaterialIndex> named_; // in the order of the file
    std::size_t material_count_ = 0;
    std::vector<TextPosition> lights_;     // of their positions
    std::vector<core::IdRange> generated_; // the shapes of each object that is more than one
    bool has_lights_ = false, has_objects_ = false;
    MaterialOf material_of_ = [this](const JsonValue& value) { return material_of(value); };
};

void SceneReader::take(const RootKey& key, std::string_view name, const JsonDocument& item) {
    const JsonValue value = item.root();
    if (key.name == "$schema")
        static_cast<void>(value.string());
    else if (key.name == "image")
        take_settings(value, read_image);
    else if (key.name == "sampling")
        take_settings(value, read_sampling);
    else if (key.name == "limits")
        take_settings(value, read_limits);
    else if (key.name == "outline")
        take_outline(value);
    else if (key.name == "camera")
        take_camera(value);
    else if (key.name == "background")
        take_background(value);
    else if (key.name == "fog")
        take_fog(value);
    else if (key.name == "spectrum")
        take_spectrum(value);
    else if (key.name == "lights")
        take_light(value);
    else if (key.name == "materials")
        take_material(name, value);
    else if (key.name == "definitions")
        take_definition(name, value);
    else
        take_object(value);
}

// core keeps in one place what the file groups by purpose, under the same names.
void SceneReader::take_settings(const JsonValue& value,
                                void (*read)(const JsonValue&, core::Settings&)) {
    core::Settings settings = builder_.settings;
    read(value, settings);
    checked(value, [&] { core::validate(settings); });
    builder_.settings = settings;
}

void SceneReader::take_outline(const JsonValue& value) {
    const core::Outline outline = read_outline(value);
    checked(value, [&] { core::validate(outline); });
    builder_.settings.outline = outline;
}

void SceneReader::take_camera(const JsonValue& value) {
    const core::Camera camera = read_camera(value);
    checked(value, [&] { core::validate(camera); });
    builder_.camera = camera;
}

void SceneReader::take_background(const JsonValue& value) {
    const core::Color color = value.color();
    checked(value, [&] {
        try {
            core::validate_color("", color);
        } catch (const core::InvalidValue& invalid) {
            throw core::InvalidValue(invalid.field.substr(1), invalid.expectation); // from "/0"
        }
    });
    builder_.background = color;
}

void SceneReader::take_fog(const JsonValue& value) {
    const core::Fog fog = read_fog(value);
    checked(value, [&] { core::validate(fog); });
    builder_.fog = fog;
}

void SceneReader::take_spectrum(const JsonValue& value) {
    value.allow_only({"wavelengths"});
    builder_.wavelengths.clear();
    for (const JsonValue& wavelength : value.at("wavelengths").array("numbers"))
        builder_.wavelengths.push_back(wavelength.real());
}

void SceneReader::take_light(const JsonValue& value) {
    has_lights_ = true;
    checked(value, [&] { builder_.add_light(read_light(value)); });
    lights_.push_back(value.toward("position").positions().value);
}

void SceneReader::take_material(std::string_view name, const JsonValue& value) {
    if (materials_.contains(name)) {
        InputError repeated = value.error("must be given only once");
        repeated.position = value.positions().key;
        throw BadInput({repeated});
    }
    const auto entry = materials_.emplace(name, 0).first;
    entry->second = add_material(value);
    named_.push_back(entry->second);
}

void SceneReader::take_definition(std::string_view name, const JsonValue& value) {
    if (definitions_.contains(name)) {
        InputError repeated = value.error("must be given only once");
        repeated.position = value.positions().key;
        throw BadInput({repeated});
    }
    definitions_.emplace(name, described_object(value, {material_of_, definitions_}));
}

void SceneReader::take_object(const JsonValue& value) {
    has_objects_ = true;
    const std::size_t before = builder_.shape_count();
    add_object(value, builder_, {material_of_, definitions_});
    const std::size_t after = builder_.shape_count();
    if (after - before > 1)
        generated_.push_back(
            {static_cast<core::ShapeId>(before), static_cast<core::ShapeId>(after - 1)});
}

core::MaterialIndex SceneReader::add_material(const JsonValue& value) {
    const core::Material material = read_material(value);
    return checked(value, [&] {
        try {
            return add(material);
        } catch (const core::InvalidValue& invalid) {
            throw core::InvalidValue(key_of_material_field(invalid.field, material.pattern.kind),
                                     invalid.expectation);
        }
    });
}

core::MaterialIndex SceneReader::material_of(const JsonValue& value) {
    if (value.type() == JsonType::object) return add_material(value);
    if (value.type() != JsonType::string)
        value.fail_expecting("the name of a material, or a material");
    const auto found = materials_.find(value.string());
    return found != materials_.end() ? found->second : index_of_unknown(value);
}

/// A name is reported once, and as soon as the materials are known. They may come behind the
/// objects, so until then it stands for one that will.
core::MaterialIndex SceneReader::index_of_unknown(const JsonValue& value) {
    const auto found = unknown_names_.find(value.string());
    if (found != unknown_names_.end()) return found->second.index;
    const bool hopeless = !materials_.empty();
    const core::MaterialIndex index = add({});
    unknown_names_.emplace(value.string(),
                           UnknownName{index, value.positions().value, value.pointer(), hopeless});
    if (hopeless) value.fail(complaint_about_name(value.string()));
    return index;
}

std::string SceneReader::complaint_about_name(std::string_view name) const {
    std::vector<std::string_view> names;
    for (const auto& [known, index] : materials_)
        names.push_back(known);
    return "must be the name of a material, got \"" + printable(name) + '"' +
           suggestion(name, names);
}

/// Named materials first, whether they came before the objects or behind them.
void SceneReader::number_materials() {
    if (unknown_names_.empty() && (named_.empty() || named_.back() + 1 == named_.size())) return;
    constexpr auto none = std::numeric_limits<core::MaterialIndex>::max();
    std::vector<core::MaterialIndex> new_index(material_count_, none);
    core::MaterialIndex next = 0;
    for (const core::MaterialIndex index : named_)
        new_index[index] = next++;
    for (const auto& [name, unknown] : unknown_names_)
        new_index[unknown.index] = new_index[materials_.at(name)];
    for (core::MaterialIndex& index : new_index)
        if (index == none) index = next++;
    builder_.renumber_materials(new_index);
}

core::Scene SceneReader::finish(const Outline& outline, InputErrors& errors) {
    for (const auto& [name, unknown] : unknown_names_)
        if (!unknown.reported && !materials_.contains(name))
            errors.add({std::string(file_), unknown.position, unknown.pointer,
                        complaint_about_name(name)});
    if (has_objects_ && !has_lights_)
        errors.add({std::string(file_), outline.of("lights"), "/lights",
                    "must have at least one light where there are objects, got none"});
    errors.report();

    number_materials();
    const auto object_of = [this](core::ShapeId id) {
        return "/objects/" + std::to_string(core::rank_in_groups(generated_, id));
    };
    try {
        return std::move(builder_).build(object_of);
    } catch (const core::InvalidValue& invalid) {
        throw BadInput({error_in_scene(invalid, outline)});
    }
}

/// What is left for core to find are lights: "lights/0/position".
InputError SceneReader::error_in_scene(const core::InvalidValue& invalid,
                                       const Outline& outline) const {
    constexpr std::string_view lights = "lights/";
    TextPosition position = outline.of(invalid.field.substr(0, invalid.field.find('/')));
    const std::string_view field = invalid.field;
    std::size_t light = lights_.size();
    if (field.starts_with(lights))
        std::from_chars(field.data() + lights.size(), field.data() + field.size(), light);
    if (light < lights_.size()) position = lights_[light];
    return {std::string(file_), position, "/" + invalid.field, invalid.expectation};
}

} // namespace

core::Scene read_json(InputFile& file, core::Workers* workers) {
    SceneReader reader(file.name(), workers);
    InputErrors errors;
    const Outline outline = read_items(
        file, SceneReader::keys,
        [&](const RootKey& key, std::string_view name, const JsonDocument& item) {
            reader.take(key, name, item);
        },
        errors);
    return reader.finish(outline, errors);
}

} // namespace raylane::scenes
