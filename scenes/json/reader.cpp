#include "scenes/json/reader.hpp"

#include "scenes/errors.hpp"
#include "scenes/json/items.hpp"
#include "scenes/json/material.hpp"
#include "scenes/json/object.hpp"
#include "scenes/json/surroundings.hpp"

#include <array>
#include <deque>
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

    void take(const RootKey& key, std::string_view name, const JsonDocument& item);
    core::Scene finish();

    static constexpr std::array<RootKey, 10> keys = {{
        {"$schema", Holds::one_item},
        {"image", Holds::one_item},
        {"sampling", Holds::one_item},
        {"limits", Holds::one_item},
        {"camera", Holds::one_item, true},
        {"background", Holds::one_item},
        {"fog", Holds::one_item},
        {"lights", Holds::item_list},
        {"materials", Holds::named_items},
        {"objects", Holds::item_list, true},
    }};

  private:
    core::MaterialIndex add_material(const JsonValue& value);
    core::MaterialIndex material_of(const JsonValue& value);
    void add_named_material(std::string_view name, const JsonValue& value);
    void take_object(const JsonDocument& item);
    void add_object(const JsonDocument& item);

    std::string_view file_;
    core::SceneBuilder builder_;
    std::map<std::string, core::MaterialIndex, std::less<>> materials_;
    std::deque<JsonDocument> waiting_;     // objects that came before the materials
    std::vector<core::IdRange> generated_; // the shapes of each object that is more than one
    MaterialOf material_of_ = [this](const JsonValue& value) { return material_of(value); };
};

void SceneReader::take(const RootKey& key, std::string_view name, const JsonDocument& item) {
    const JsonValue value = item.root();
    if (key.name == "$schema")
        static_cast<void>(value.string());
    else if (key.name == "image")
        read_image(value, builder_.settings);
    else if (key.name == "sampling")
        read_sampling(value, builder_.settings);
    else if (key.name == "limits")
        read_limits(value, builder_.settings);
    else if (key.name == "camera")
        builder_.camera = read_camera(value);
    else if (key.name == "background")
        builder_.background = value.color();
    else if (key.name == "fog")
        builder_.fog = read_fog(value);
    else if (key.name == "lights")
        checked(value, [&] { builder_.add_light(read_light(value)); });
    else if (key.name == "materials")
        add_named_material(name, value);
    else
        take_object(item);
}

core::MaterialIndex SceneReader::add_material(const JsonValue& value) {
    const core::Material material = read_material(value);
    return checked(value, [&] {
        try {
            return builder_.add_material(material);
        } catch (const core::InvalidValue& invalid) {
            throw core::InvalidValue(key_of_material_field(invalid.field, material.pattern.kind),
                                     invalid.expectation);
        }
    });
}

void SceneReader::add_named_material(std::string_view name, const JsonValue& value) {
    if (materials_.contains(name)) value.fail("must be given only once");
    materials_.emplace(name, add_material(value));
}

core::MaterialIndex SceneReader::material_of(const JsonValue& value) {
    if (value.type() == JsonType::object) return add_material(value);
    if (value.type() != JsonType::string)
        value.fail_expecting("the name of a material, or a material");
    const auto found = materials_.find(value.string());
    if (found != materials_.end()) return found->second;
    std::vector<std::string_view> names;
    for (const auto& [name, index] : materials_)
        names.push_back(name);
    value.fail("must be the name of a material, got " + value.quoted() +
               suggestion(value.string(), names));
}

void SceneReader::take_object(const JsonDocument& item) {
    // Objects keep their order, which numbers the shapes: none overtakes one that waits.
    const bool known = item.root().at("material").type() != JsonType::string || !materials_.empty();
    if (known && waiting_.empty())
        add_object(item);
    else
        waiting_.push_back(item);
}

void SceneReader::add_object(const JsonDocument& item) {
    const std::size_t before = builder_.shape_count();
    scenes::add_object(item.root(), builder_, material_of_);
    const std::size_t after = builder_.shape_count();
    if (after - before > 1)
        generated_.push_back(
            {static_cast<core::ShapeId>(before), static_cast<core::ShapeId>(after - 1)});
}

core::Scene SceneReader::finish() {
    for (const JsonDocument& item : waiting_)
        add_object(item);
    waiting_ = {};
    const auto object_of = [this](core::ShapeId id) {
        return "/objects/" + std::to_string(core::rank_in_groups(generated_, id));
    };
    try {
        return std::move(builder_).build(object_of);
    } catch (const core::InvalidValue& invalid) {
        // core keeps in one place what the file groups by purpose.
        static constexpr std::array<std::pair<std::string_view, std::string_view>, 5> places = {{
            {"settings/width", "image/width"},
            {"settings/height", "image/height"},
            {"settings/grid", "sampling/grid"},
            {"settings/max_depth", "limits/max_depth"},
            {"settings/min_weight", "limits/min_weight"},
        }};
        std::string place = invalid.field;
        for (const auto& [field, pointer] : places)
            if (invalid.field == field) place = pointer;
        throw BadInput(file_, "/" + place, invalid.expectation);
    }
}

} // namespace

core::Scene read_json(InputFile& file, core::Workers* workers) {
    SceneReader reader(file.name(), workers);
    read_items(file, SceneReader::keys,
               [&](const RootKey& key, std::string_view name, const JsonDocument& item) {
                   reader.take(key, name, item);
               });
    return reader.finish();
}

} // namespace raylane::scenes
