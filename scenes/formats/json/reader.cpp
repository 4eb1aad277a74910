#include "scenes/formats/json/reader.hpp"

#include "core/scene/validate.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/json/fields.hpp"
#include "scenes/formats/json/inclusion.hpp"
#include "scenes/formats/json/items.hpp"
#include "scenes/formats/json/material.hpp"
#include "scenes/formats/json/object.hpp"
#include "scenes/formats/json/object_places.hpp"
#include "scenes/formats/json/pattern_images.hpp"
#include "scenes/formats/json/surroundings.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace raylane::scenes {

namespace {

/// Throws for a name that has already been given.
[[noreturn]] void refuse_again(const JsonValue& value) {
    InputError repeated = value.error("must be given only once");
    repeated.position = value.positions().key;
    throw BadInput({repeated});
}

/// Collects a scene from the items of its file.
class SceneReader {
  public:
    SceneReader(std::string_view file, core::Workers* workers, Parameters parameters)
        : file_(file), inclusion_(file_), parameters_(std::move(parameters)) {
        builder_.workers = workers;
    }

    /// Refuses the inclusion of other files from now on.
    void stand_alone() { may_include_ = false; }
    /// Takes all items of a file: the main one, or an included one.
    Outline take_all(InputFile& file, InputErrors& errors);
    /// Builds the scene. Throws BadInput for `errors` and for errors in the scene as a whole.
    core::Scene finish(const Outline& outline, InputErrors& errors);
    core::Scene finish_with(core::BuiltShapes shapes, InputErrors& errors);

    static constexpr std::array<RootKey, 15> keys = {{
        {"$schema", Holds::one_item},
        {"parameters", Holds::named_items},
        {"include", Holds::item_list},
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
    /// Returns true for keys that an included file contributes. That file may also be a complete
    /// scene.
    static bool is_included(std::string_view key) {
        return key == "parameters" || key == "include" || key == "lights" || key == "materials" ||
               key == "definitions" || key == "objects";
    }

    /// A material's name that is used before its material comes, or without one. Holds the place of
    /// the first use, and an index that stands for the material until it comes.
    struct UnknownName {
        core::MaterialIndex index;
        std::string file;
        TextPosition position;
        std::string pointer;
        bool reported;
    };
    /// A file whose names of materials are looked up first.
    class OpenFile {
      public:
        explicit OpenFile(SceneReader& reader) : reader_(reader) {
            reader.open_files_.push_back(reader.files_.size());
            reader.files_.emplace_back();
        }
        ~OpenFile() { reader_.open_files_.pop_back(); }
        OpenFile(const OpenFile&) = delete;
        OpenFile& operator=(const OpenFile&) = delete;

      private:
        SceneReader& reader_;
    };

    using NamedMaterials = std::map<std::string, core::MaterialIndex, std::less<>>;
    /// The place of a light in its file.
    struct LightPlace {
        std::string file, pointer;
        TextPosition position;
    };
    /// Throws BadInput for an invalid item. Further items can be taken after that.
    void take(const RootKey& key, std::string_view name, const JsonDocument& item);
    /// Notes a root key that is missing because of an error.
    void miss(std::string_view key);
    void include(const JsonValue& value);
    void take_settings(std::string_view group, const JsonValue& value);
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
    /// Returns true if a known error may be the reason that items of a root key are missing.
    bool misses(std::string_view key) const {
        return missed_.contains(key) || missed_.contains("include");
    }
    InputError error_in_scene(const core::InvalidValue& invalid, const Outline& outline) const;

    std::string file_; // the main file
    Inclusion inclusion_;
    Parameters parameters_;
    core::SceneBuilder builder_;
    NamedMaterials materials_;            // the first of each name
    std::vector<NamedMaterials> files_;   // materials of each file, in the order of reading
    std::vector<std::size_t> open_files_; // indices; the last is the file that is being read
    std::map<std::pair<std::size_t, std::string>, UnknownName> unknown_names_; // by file and name
    Definitions definitions_;
    // Names of other files' materials that a file used before it had any: by file.
    std::set<std::pair<std::size_t, std::string>> borrowed_;
    std::vector<core::MaterialIndex> named_; // in the order of the files
    std::size_t material_count_ = 0;
    std::vector<LightPlace> lights_;
    ObjectPlaces objects_;
    bool has_lights_ = false, has_objects_ = false;
    bool may_include_ = true;
    PatternImages images_;
    std::set<std::string_view> missed_; // root keys with errors, whose items may be missing
    MaterialOf material_of_ = [this](const JsonValue& value) { return material_of(value); };
};

Outline SceneReader::take_all(InputFile& file, InputErrors& errors) {
    const bool is_first = inclusion_.depth() == 0;
    const OpenFile open(*this);
    std::array<RootKey, keys.size()> known = keys;
    for (RootKey& key : known)
        key.required = key.required && is_first;
    std::set<std::string, std::less<>> parameters; // of this file; across files the first counts
    return read_items(
        file, known,
        [&](const RootKey& key, std::string_view name, const JsonDocument& item) {
            if (key.name == "parameters" && !parameters.emplace(name).second)
                refuse_again(item.root());
            if (is_first || is_included(key.name)) take(key, name, item);
        },
        [&](std::string_view key) { miss(key); }, errors, parameters_);
}

void SceneReader::take(const RootKey& key, std::string_view name, const JsonDocument& item) {
    const JsonValue value = item.root();
    if (key.name == "$schema")
        static_cast<void>(value.string());
    else if (key.name == "parameters")
        read_parameter(name, value, parameters_);
    else if (key.name == "include")
        include(value);
    else if (key.name == "image" || key.name == "sampling" || key.name == "limits")
        take_settings(key.name, value);
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

void SceneReader::miss(std::string_view key) {
    missed_.insert(key);
    parameters_.miss(key);
    if (key == "definitions" || key == "include") definitions_.may_lack_some = true;
}

void SceneReader::include(const JsonValue& value) {
    if (!may_include_) value.fail("must not be included by a built scene");
    try {
        inclusion_.include(value, [&](InputFile& file) {
            objects_.enter(file.name(), builder_.shape_count());
            InputErrors errors;
            static_cast<void>(take_all(file, errors));
            errors.report();
            objects_.leave(builder_.shape_count());
        });
    } catch (const BadInput&) {
        miss("include");
        throw;
    }
}

// The file groups by purpose the settings that core keeps in one struct. The names are the same.
void SceneReader::take_settings(std::string_view group, const JsonValue& value) {
    core::Settings settings = builder_.settings;
    read_only_fields(value, settings, group);
    checked(value, [&] { core::validate(settings); });
    builder_.settings = settings;
}

void SceneReader::take_outline(const JsonValue& value) {
    const core::Outline outline = read_outline(value);
    checked(value, [&] { core::validate(outline); });
    builder_.settings.outline = outline;
}

void SceneReader::take_camera(const JsonValue& value) {
    missed_.insert("camera"); // an invalid camera may be meant to bring light along
    const core::Camera camera = read_camera(value, builder_.auto_camera);
    checked(value, [&] { core::validate(camera); });
    builder_.camera = camera;
    missed_.erase("camera");
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
    const std::optional<core::Light> light = read_light(value);
    if (!light) {
        builder_.auto_camera.lights = true;
        return;
    }
    checked(value, [&] { builder_.add_light(*light); });
    lights_.push_back(
        {std::string(value.file()), value.pointer(), value.toward("position").positions().value});
}

// A file's objects use its materials first, and those of other files for other names.
void SceneReader::take_material(std::string_view name, const JsonValue& value) {
    NamedMaterials& own = files_[open_files_.back()];
    if (own.contains(name)) refuse_again(value);
    if (borrowed_.contains({open_files_.back(), std::string(name)}))
        value.fail("must come before the objects that use it, because another file has a material "
                   "of this name");
    const auto entry = own.emplace(name, 0).first;
    try {
        entry->second = add_material(value);
    } catch (const BadInput&) {
        entry->second = add({}); // otherwise each object that uses it would be an error, too
        materials_.emplace(name, entry->second);
        throw;
    }
    std::string unique(name);
    for (int k = 2; !materials_.emplace(unique, entry->second).second; ++k)
        unique = std::string(name) + '-' + std::to_string(k);
    // The writer names a material without a name by its number.
    if (unique != std::to_string(named_.size())) builder_.name_material(entry->second, unique);
    named_.push_back(entry->second);
}

void SceneReader::take_definition(std::string_view name, const JsonValue& value) {
    if (definitions_.contains(name)) refuse_again(value);
    try {
        definitions_.add(name, described_object(value, {material_of_, definitions_, builder_}));
    } catch (const BadInput&) {
        definitions_.add(name, std::nullopt);
        throw;
    }
}

void SceneReader::take_object(const JsonValue& value) {
    has_objects_ = true;
    const std::size_t before = builder_.shape_count();
    add_object(value, builder_, {material_of_, definitions_, builder_});
    objects_.add(before, builder_.shape_count() - before);
}

core::MaterialIndex SceneReader::add_material(const JsonValue& value) {
    core::Material material = read_material(value);
    if (material.pattern.kind == core::PatternKind::image) {
        const JsonValue file = value.toward("pattern/file");
        if (!may_include_) file.fail("must not be an image in a built scene");
        material.pattern.image = images_.named_by(file);
    }
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
    const NamedMaterials& own = files_[open_files_.back()];
    if (const auto found = own.find(value.string()); found != own.end()) return found->second;
    const auto of_others = materials_.find(value.string());
    if (of_others == materials_.end()) return index_of_unknown(value);
    if (own.empty()) borrowed_.emplace(open_files_.back(), value.string());
    return of_others->second;
}

/// Returns an index that stands for the material until it comes: materials may come after the
/// objects. Reports an unknown name only once, and as soon as the materials are known.
core::MaterialIndex SceneReader::index_of_unknown(const JsonValue& value) {
    const std::pair key(open_files_.back(), std::string(value.string()));
    const auto found = unknown_names_.find(key);
    if (found != unknown_names_.end()) return found->second.index;
    const bool hopeless = !materials_.empty() && !misses("materials");
    ++material_count_;
    const core::MaterialIndex index = builder_.add_placeholder();
    unknown_names_.emplace(key, UnknownName{index, std::string(value.file()),
                                            value.positions().value, value.pointer(), hopeless});
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

/// Numbers the named materials first, whether they come before or after the objects.
void SceneReader::number_materials() {
    if (unknown_names_.empty() && (named_.empty() || named_.back() + 1 == named_.size())) return;
    constexpr auto none = std::numeric_limits<core::MaterialIndex>::max();
    std::vector<core::MaterialIndex> new_index(material_count_, none);
    core::MaterialIndex next = 0;
    for (const core::MaterialIndex index : named_)
        new_index[index] = next++;
    for (const auto& [key, unknown] : unknown_names_) {
        const NamedMaterials& own = files_[key.first];
        const auto found = own.find(key.second);
        new_index[unknown.index] =
            new_index[found != own.end() ? found->second : materials_.at(key.second)];
    }
    for (core::MaterialIndex& index : new_index)
        if (index == none) index = next++;
    builder_.renumber_materials(new_index);
}

core::Scene SceneReader::finish(const Outline& outline, InputErrors& errors) {
    for (const auto& [key, unknown] : unknown_names_)
        if (!unknown.reported && !materials_.contains(key.second) && !misses("materials"))
            errors.add({unknown.file, unknown.position, unknown.pointer,
                        complaint_about_name(key.second)});
    // A camera that finds its place by itself brings light, too. An empty list is intended.
    builder_.wants_light = has_lights_ || !outline.has("lights");
    if (!has_lights_ && builder_.wants_light && builder_.auto_camera.fit_camera)
        builder_.auto_camera.lights = true;
    if (has_objects_ && !has_lights_ && builder_.wants_light && !builder_.auto_camera.lights &&
        !misses("lights") && !misses("camera"))
        errors.add({file_, outline.of("lights"), "/lights",
                    "must have at least one light if there are objects, or be [] for no lights, "
                    "got none"});
    errors.report();
    if (const auto unused = parameters_.first_unused()) {
        std::vector<std::string_view> others = parameters_.names();
        std::erase(others, *unused);
        throw BadInput(file_, "",
                       "has no parameter \"$" + *unused + '"' + suggestion(*unused, others, "$"));
    }

    number_materials();
    try {
        return std::move(builder_).build([this](core::ShapeId id) { return objects_.name_of(id); });
    } catch (const core::InvalidValue& invalid) {
        throw BadInput({error_in_scene(invalid, outline)});
    }
}

core::Scene SceneReader::finish_with(core::BuiltShapes shapes, InputErrors& errors) {
    errors.report();
    number_materials();
    try {
        return std::move(builder_).build(std::move(shapes));
    } catch (const core::InvalidValue& invalid) {
        throw BadInput(file_, "", std::string("is damaged: ") + invalid.what());
    }
}

/// Returns an error that only core finds, with its place in the file: in lights
/// ("lights/0/position"), or in a camera that cannot see the scene.
InputError SceneReader::error_in_scene(const core::InvalidValue& invalid,
                                       const Outline& outline) const {
    constexpr std::string_view lights = "lights/";
    const std::string_view field = invalid.field;
    std::size_t index = lights_.size();
    const char* end = field.data();
    if (field.starts_with(lights))
        end = std::from_chars(field.data() + lights.size(), field.data() + field.size(), index).ptr;
    if (index >= lights_.size())
        return {file_, outline.of(field.substr(0, field.find('/'))), "/" + invalid.field,
                invalid.expectation};
    const LightPlace& light = lights_[index];
    return {light.file, light.position,
            light.pointer + std::string(end, field.data() + field.size()), invalid.expectation};
}

} // namespace

core::Scene read_json(InputFile& file, core::Workers* workers,
                      const std::map<std::string, double>& given) {
    const auto read = [&](Parameters parameters) {
        SceneReader reader(file.name(), workers, std::move(parameters));
        InputErrors errors;
        const Outline outline = reader.take_all(file, errors);
        return reader.finish(outline, errors);
    };
    Parameters parameters(given);
    parameters.expects_more = true;
    try {
        return read(parameters);
    } catch (const LateParameter& late) {
        if (!file.rewind()) {
            InputError error = late.error.errors().front();
            error.message += "; in a pipe, it must come before its use";
            throw BadInput({error});
        }
    }
    // The parameters come after the values that refer to them.
    parameters.expects_more = false;
    take_parameters(file, SceneReader::keys, parameters);
    if (!file.rewind()) throw SystemRefused(file.name(), "read again", errno);
    return read(std::move(parameters));
}

core::Scene read_json_with(InputFile& file, core::BuiltShapes shapes, core::Workers* workers) {
    SceneReader reader(file.name(), workers, Parameters());
    reader.stand_alone();
    InputErrors errors;
    static_cast<void>(reader.take_all(file, errors));
    return reader.finish_with(std::move(shapes), errors);
}

} // namespace raylane::scenes
