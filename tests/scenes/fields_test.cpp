#include "core/scene/fields.hpp"
#include "core/scene/surroundings.hpp"
#include "scenes/files/number.hpp"
#include "tests/places.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

// The schema and the table of keys in scenes/README.md follow core/scene/fields.hpp.

using namespace raylane;

namespace {

using core::fields::Field, core::fields::Kinds, core::fields::Rule, core::fields::for_each_field;
using nlohmann::json;
using Keys = std::set<std::string>;

/// An object in JSON: its definition in the schema, and its fields.
struct Object {
    const char* definition;
    Kinds kind = core::fields::every;
    const char* group = "";
    Keys others{}; ///< keys that are no fields
};

json schema() {
    return json::parse(std::ifstream(RAYLANE_SOURCE_DIR "/scenes/raylane-scene.schema.json"));
}

/// Returns a property with the keys of the definitions that it refers to.
json resolved(const json& schema, const json& property) {
    json expected = json::object();
    if (property.contains("$ref"))
        expected = resolved(schema, schema.at(json::json_pointer(
                                        property.at("$ref").get<std::string>().substr(1))));
    if (property.contains("allOf")) expected.update(resolved(schema, property.at("allOf").at(0)));
    expected.update(property);
    return expected;
}

/// Returns the limits of a property's numbers, as in a schema.
json limits_of(const json& schema, const json& property) {
    for (const char* choice : {"anyOf", "oneOf"})
        for (const json& alternative : property.value(choice, json::array()))
            if (!alternative.contains("const"))
                return limits_of(schema, resolved(schema, alternative));
    if (property.contains("items"))
        return limits_of(schema, resolved(schema, property.at("items")));
    json limits = json::object();
    for (const char* key : {"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"})
        if (property.contains(key)) limits[key] = property.at(key).get<double>();
    return limits;
}

/// Returns the same for a field. Files hold finite numbers only.
json limits_of(const core::fields::Valid& valid) {
    const double most = std::min(valid.most, core::fields::limit);
    switch (valid.rule) {
    case Rule::positive:
        return {{"exclusiveMinimum", valid.least}, {"maximum", most}};
    case Rule::inside:
        return {{"exclusiveMinimum", valid.least}, {"exclusiveMaximum", most}};
    case Rule::number:
    case Rule::number_or_0:
    case Rule::count:
    case Rule::direction:
        return {{"minimum", valid.least}, {"maximum", most}};
    default:
        return json::object();
    }
}

json words_of(const core::fields::Valid& valid) {
    return std::vector<std::string>(valid.words.begin() + valid.hidden_words, valid.words.end());
}

/// Returns the default value of a field in JSON; null if it has none of its own.
template <class Value>
json default_of(const Field& field, const Value& value) {
    if constexpr (std::is_enum_v<Value>) {
        const auto index = static_cast<int>(value);
        if (index >= field.valid.hidden_words) return field.valid.words[index];
    } else if constexpr (std::is_same_v<Value, std::uint8_t>) {
        if (field.spelling.first_bit == 0) return "xz";
    } else if constexpr (std::is_same_v<Value, float>) {
        if (value <= std::numeric_limits<float>::max()) return std::stod(scenes::to_text(value));
    } else if constexpr (std::is_arithmetic_v<Value>) {
        return value;
    } else if constexpr (std::is_same_v<Value, core::Vec3f>) {
        return {value.x, value.y, value.z};
    }
    return nullptr;
}

template <class Of>
void check_schema(const std::vector<Object>& objects) {
    const json schema = ::schema();
    std::map<std::string, bool> is_described; // by the descriptions of fields
    for (const Object& object : objects) {
        const json& definition = schema.at("definitions").at(object.definition);
        Keys keys = object.others, required;
        const Of usual{};
        for_each_field(
            [&](const Field& field, const auto& value) {
                if (!field.is_in(object.group, object.kind)) return;
                const std::string key(field.key());
                INFO(object.definition << "/" << key);
                keys.insert(key);
                const bool is_required = (field.use.required & object.kind) != 0;
                if (is_required) required.insert(key);
                const json property =
                    resolved(schema, definition.at("properties").value(key, json::object()));
                if (field.use.selects_kind) return;
                is_described[field.about] |=
                    property.value("description", "").starts_with(field.about);
                CHECK(property.value("enum", json::array()) ==
                      (field.valid.rule == Rule::axes ? json{"x", "y", "z", "xy", "xz", "yz", "xyz"}
                                                      : words_of(field.valid)));
                if (field.valid.rule != Rule::several)
                    CHECK(limits_of(schema, property) == limits_of(field.valid));
                if (!is_required &&
                    property.value("description", "").find("Default:") == std::string::npos)
                    CHECK(property.value("default", json()) == default_of(field, value));
            },
            usual);
        INFO(object.definition);
        Keys keys_in_schema, required_in_schema;
        for (const auto& [key, property] : definition.at("properties").items())
            if (!property.value("deprecated", false)) keys_in_schema.insert(key);
        for (const json& key : definition.value("required", json::array()))
            required_in_schema.insert(key.get<std::string>());
        CHECK(keys_in_schema == keys);
        CHECK(required_in_schema == required);
    }
    for (const auto& [about, found] : is_described) {
        INFO(about);
        CHECK(found);
    }
}

/// Returns the keys of a row in the README's table with their defaults, such as "`grid` 1" or, for
/// a required key, "**from**". Omits the defaults of `vectors`.
Keys keys_in_readme(const std::string& row, const Keys& vectors) {
    const std::string readme = tests::content_of(RAYLANE_SOURCE_DIR "/scenes/README.md");
    const std::string start = "\n| `" + row + "` | ";
    const std::size_t begin = readme.find(start) + start.size();
    const std::string text = readme.substr(begin, readme.find(" |\n", begin) - begin);
    const std::regex key(R"((\*\*[a-z_]+\*\*)|`([a-z_]+)`( [^ ,;]+)?)");
    Keys keys;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), key);
         match != std::sregex_iterator(); ++match) {
        const std::string required = (*match)[1], name = (*match)[2], value = (*match)[3];
        keys.insert(!required.empty() ? required
                                      : "`" + name + "`" + (vectors.contains(name) ? "" : value));
    }
    return keys;
}

/// Checks that a row has these keys, and the defaults that are numbers or words.
template <class Of>
void check_readme(const std::string& row, Kinds kinds, const char* group = "",
                  const Keys& others = {}) {
    const Of usual{};
    Keys expected = others, vectors;
    for_each_field(
        [&](const Field& field, const auto& value) {
            if (!field.is_in(group, kinds) || field.use.selects_kind) return;
            const std::string key(field.key());
            const Kinds required = field.use.required & kinds;
            if (required != 0) expected.insert("**" + key + "**");
            if ((field.use.used & kinds) == required) return;
            const json own = default_of(field, value);
            if (own.is_array()) vectors.insert(key);
            std::string text = own.is_string() ? own.get<std::string>() : own.dump();
            if (text.ends_with(".0")) text.resize(text.size() - 2);
            expected.insert("`" + key + "`" + (own.is_null() || own.is_array() ? "" : " " + text));
        },
        usual);
    INFO(row);
    CHECK(keys_in_readme(row, vectors) == expected);
}

/// Converts to the type of any member.
struct AnyMember {
    template <class Member>
    operator Member() const;
};

/// Returns the number of members of a struct.
template <class Of, class... Members>
constexpr std::size_t member_count() {
    if constexpr (requires { Of{Members{}..., AnyMember{}}; })
        return member_count<Of, Members..., AnyMember>();
    else
        return sizeof...(Members);
}

template <class Of>
std::size_t described_members() {
    const Of usual{};
    Keys names;
    for_each_field([&](const Field& field, const auto&) { names.insert(field.name); }, usual);
    return names.size();
}

constexpr Kinds kind(int index) {
    return 1U << index;
}

} // namespace

TEST_CASE("the lists of fields have all members") {
    CHECK(described_members<core::Pattern>() == member_count<core::Pattern>());
    CHECK(described_members<core::Sellmeier>() == member_count<core::Sellmeier>());
    CHECK(described_members<core::Material>() == member_count<core::Material>());
    CHECK(described_members<core::Light>() == member_count<core::Light>());
    CHECK(described_members<core::Fog>() == member_count<core::Fog>());
    CHECK(described_members<core::Camera>() == member_count<core::Camera>());
    CHECK(described_members<core::Outline>() == member_count<core::Outline>());
    CHECK(described_members<core::Settings>() == member_count<core::Settings>());
}

TEST_CASE("the schema has the keys, ranges, words, defaults and descriptions of the fields") {
    check_schema<core::Settings>({{"image", core::fields::every, "image"},
                                  {"sampling", core::fields::every, "sampling"},
                                  {"limits", core::fields::every, "limits"}});
    check_schema<core::Outline>({{"outline"}});
    check_schema<core::Camera>({{"perspectiveCamera", kind(0)}, {"orthographicCamera", kind(1)}});
    check_schema<core::Fog>(
        {{"fogByZ", kind(1)}, {"fogByDistance", kind(2)}, {"exponentialFog", kind(3)}});
    check_schema<core::Light>({{"pointLight", kind(0)},
                               {"directionalLight", kind(1)},
                               {"skyLight", kind(2)},
                               {"sphereLight", kind(3)},
                               {"discLight", kind(4)},
                               {"rectangleLight", kind(5)}});
    check_schema<core::Pattern>(
        {{"checker", kind(1)},
         {"stripes", kind(2)},
         {"gradient", kind(3)},
         {"formula", kind(4), "", {"scale", "rotate", "translate", "transform"}},
         {"imagePattern", kind(5)}});
    check_schema<core::Material>({{"material", core::fields::every, "", {"preset", "color"}}});
}

TEST_CASE("the table of keys in the README has the fields and their defaults") {
    using core::fields::every;
    for (const char* group : {"image", "sampling", "limits"})
        check_readme<core::Settings>(group, every, group);
    check_readme<core::Outline>("outline", every);
    check_readme<core::Camera>("camera", kind(0) | kind(1));
    check_readme<core::Fog>("fog", kind(1) | kind(2) | kind(3));
    check_readme<core::Light>("lights", every >> 26);
    check_readme<core::Material>("materials", every, "", {"`preset` matte", "`color`"});
}

TEST_CASE("the limits of the settings are those of the fields") {
    const auto most = []<class Of>(const Of& object, std::string_view name) {
        double result = 0.0;
        for_each_field(
            [&](const Field& field, const auto&) {
                if (field.name == name) result = field.valid.most;
            },
            object);
        return result;
    };
    using core::Settings;
    CHECK(most(Settings{}, "width") == Settings::max_size);
    CHECK(most(Settings{}, "height") == Settings::max_size);
    CHECK(most(Settings{}, "grid") == Settings::max_grid);
    CHECK(most(Settings{}, "light_samples") == Settings::max_light_samples);
    CHECK(most(Settings{}, "max_depth") == Settings::depth_limit);
    CHECK(most(Settings{}, "max_transparent") == Settings::transparent_limit);
    CHECK(most(core::Outline{}, "width") == static_cast<double>(core::Outline::max_width));
}
