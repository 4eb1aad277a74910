#include "tests/places.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

// schema_test.py checks the schema's verdicts on the same corpus.

using namespace raylane::tests;

namespace {

using nlohmann::json;
using Keys = std::set<std::string>;

json read(const std::string& path) {
    return json::parse(std::ifstream(std::string(RAYLANE_SOURCE_DIR) + "/" + path));
}

/// PICTURE stands for an image that exists.
std::string complaint_about_json(const json& scene) {
    const std::string word = "PICTURE",
                      picture = RAYLANE_SOURCE_DIR "/bench/failures/double-sum.png";
    std::string text = scene.dump();
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += picture.size())
        text.replace(at, word.size(), picture);
    return complaint_about_text(text);
}

/// Returns the base with the entry's keys in place of its keys. null removes a key.
json scene_of(json base, const json& entry) {
    for (const auto& [key, value] : entry.items()) {
        if (value.is_null())
            base.erase(key);
        else
            base[key] = value;
    }
    return base;
}

/// A key that resembles no known one, so that the reader lists all known keys.
const std::string unknown_key = "0123456789";

Keys keys_told_by(const std::string& complaint) {
    const std::string behind = ", must be ";
    const std::size_t list = complaint.find(behind);
    if (complaint.find("unknown key \"" + unknown_key + '"') == std::string::npos ||
        list == std::string::npos)
        return {"not the complaint that was expected: " + complaint};
    Keys keys;
    std::istringstream words(complaint.substr(list + behind.size()));
    std::string between, key;
    while (std::getline(words, between, '"') && std::getline(words, key, '"'))
        keys.insert(key);
    return keys;
}

Keys keys_of(const json& definition) {
    Keys keys;
    for (const auto& [key, value] : definition.at("properties").items())
        keys.insert(key);
    return keys;
}

const json& definition(const json& schema, const json& reference) {
    return schema.at(json::json_pointer(reference.at("$ref").get<std::string>().substr(1)));
}

/// Returns, for each "type" among the alternatives, the keys that its objects may have.
std::map<std::string, Keys> keys_by_type(const json& schema, const json& alternatives) {
    std::map<std::string, Keys> keys;
    for (const json& alternative : alternatives) {
        if (alternative.contains("oneOf")) {
            keys.merge(keys_by_type(schema, alternative.at("oneOf")));
            continue;
        }
        const json& object = definition(schema, alternative);
        const json& type = object.at(json::json_pointer("/properties/type"));
        if (type.contains("enum"))
            for (const json& one : type.at("enum"))
                keys[one.get<std::string>()].merge(keys_of(object));
        else
            keys[type.at("const").get<std::string>()].merge(keys_of(object));
    }
    return keys;
}

} // namespace

TEST_CASE("the reader accepts the good scenes of the schema's corpus and refuses the bad ones") {
    const json corpus = read("tests/scenes/formats/json/schema_corpus.json");
    for (const json& entry : corpus.at("good")) {
        INFO(entry);
        CHECK(complaint_about_json(scene_of(corpus.at("base"), entry)) == "");
    }
    for (const char* verdict : {"bad", "bad, but not to a schema"})
        for (const json& entry : corpus.at(verdict)) {
            INFO(entry);
            CHECK(complaint_about_json(scene_of(corpus.at("base"), entry)) != "");
        }
}

TEST_CASE("the reader and the schema know the same keys") {
    const json schema = read("scenes/raylane-scene.schema.json");
    const json base = read("tests/scenes/formats/json/schema_corpus.json").at("base");
    CHECK(keys_told_by(complaint_about_json(scene_of(base, {{unknown_key, 0}}))) ==
          keys_of(schema));

    for (const std::string part : {"image", "sampling", "limits"}) {
        const json entry = {{part, {{unknown_key, 0}}}};
        CHECK(keys_told_by(complaint_about_json(scene_of(base, entry))) ==
              keys_of(schema.at("definitions").at(part)));
    }
    const json material = {{"materials", {{"m", {{unknown_key, 0}}}}}};
    CHECK(keys_told_by(complaint_about_json(scene_of(base, material))) ==
          keys_of(schema.at("definitions").at("material")));

    struct Place {
        const char* alternatives; // in the schema
        const char* value;        // in a scene
    };
    for (const Place& place : {Place{"/properties/camera/anyOf/1/oneOf", "/camera"},
                               Place{"/properties/fog/oneOf", "/fog"},
                               Place{"/properties/lights/items/oneOf", "/lights/0"},
                               Place{"/properties/objects/items/oneOf", "/objects/0"},
                               Place{"/definitions/pattern/oneOf", "/materials/m/pattern"}})
        for (const auto& [type, keys] :
             keys_by_type(schema, schema.at(json::json_pointer(place.alternatives)))) {
            json scene = base;
            scene[json::json_pointer(place.value)] = {{"type", type}, {unknown_key, 0}};
            if (keys.contains("material"))
                scene[json::json_pointer(place.value)]["material"] = "clay";
            INFO(place.value << " of type " << type);
            CHECK(keys_told_by(complaint_about_json(scene)) == keys);
        }
}
