#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

/// Tests of the position of errors in JSON and of the number that is reported at once.
using namespace raylane;
using namespace raylane::tests;

namespace {

const std::string start = R"({
  "camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
  "lights": [{"type": "directional", "direction": [0, 0, 1]}],
  "materials": {"clay": {}},
  "objects": [
    )"; // the objects begin at line 6, column 5

std::string complaint_about_objects(const std::string& objects) {
    return placed_complaint_about_text(start + objects + "]}");
}

std::string sphere(const std::string& radius, const std::string& material = "\"clay\"") {
    return R"({"type": "sphere", "center": [0, 0, 0], "radius": )" + radius + R"(, "material": )" +
           material + "}";
}

std::vector<core::MaterialIndex> materials_of_shapes(const core::Scene& scene) {
    std::vector<core::MaterialIndex> materials;
    for (core::ShapeId id = 0; id < scene.shape_count(); ++id)
        materials.push_back(scene.material_index_of(id));
    return materials;
}

} // namespace

TEST_CASE("an error's position is where its value begins") {
    const auto complaint = complaint_about_objects;
    CHECK(complaint(sphere("-1")) == "6:55: /objects/0/radius: must be positive, got -1");
    CHECK(complaint(sphere("/* \n */ -1 ")) == "7:5: /objects/0/radius: must be positive, got -1");
    CHECK(complaint(sphere("\xC3\xBC").replace(0, 0, "/*\xC3\xBC*/")).starts_with("6:60: must"));
    CHECK(complaint("/*\xC3\xBC*/" + sphere("\"1\"")) ==
          "6:60: /objects/0/radius: must be a number, got \"1\"");
    CHECK(complaint(sphere("true")) == "6:55: /objects/0/radius: must be a number, got true");
    CHECK(complaint(sphere("[\n[]]")) == "6:55: /objects/0/radius: must be a number, got an array");
    CHECK(complaint(sphere("1e40")).starts_with("6:55: /objects/0/radius: must be"));
    CHECK(complaint(sphere("1e400")).starts_with("6:55: /objects/0/radius: must be"));
    CHECK(complaint(sphere("1", "\n{\"color\": [0,\n0,-1\n]}")) ==
          "8:3: /objects/0/material/color/2: must not be negative, got -1");
    CHECK(complaint(sphere("1", "\n\"caly\"")) ==
          "7:1: /objects/0/material: must be the name of a material, got \"caly\", did you mean "
          "\"clay\"?");
    CHECK(complaint(R"({"type": "box", "material": "clay", "min": [0, 0, 0], "max": [1,
        1,-1]})") == "7:11: /objects/0/max/2: must be more than min's 0, got -1");
    CHECK(complaint("3") == "6:5: /objects/0: must be an object, got 3");
    CHECK(complaint("{},\n[{}]").ends_with("7:1: /objects/1: must be an object, got an array"));
}

TEST_CASE("a missing key's position is where the object begins") {
    CHECK(complaint_about_objects(R"(  {"type": "sphere", "center": [0, 0, 0], "radius": 1})") ==
          R"(6:7: /objects/0: must have the key "material")");
    CHECK(placed_complaint_about_text("\n {\"objects\": []}") ==
          "2:2: must have the key \"camera\"");
    CHECK(placed_complaint_about_text(start.substr(0, start.find("\"lights\"")) + "\"objects\": [" +
                                      sphere("1", "{}") + "]}") ==
          "1:1: /lights: must have at least one light if there are objects, or be [] for no "
          "lights, got none");
}

TEST_CASE("an unexpected key's position is where the key begins") {
    CHECK(complaint_about_objects(R"({"raduis" : 1, "type": "sphere", "center": [0, 0, 0],
        "colour": 3, "material": "clay"})") ==
          "6:6: /objects/0: unknown key \"raduis\", did you mean \"radius\"?\n"
          "7:9: /objects/0: unknown key \"colour\", must be \"type\", \"material\", "
          "\"center\", \"radius\", \"scale\", \"rotate\", \"translate\" or \"transform\"");
    CHECK(complaint_about_objects("],\n \"light\": [[{\"a\": 3}], {}], \"lights\": [3") ==
          "7:2: unknown key \"light\", did you mean \"lights\"?\n"
          "7:29: /lights: must be given only once");
    CHECK(placed_complaint_about_text(start + "], \"image\": {\"width\": 1,\n\"width\": 2}}") ==
          "7:1: /image/width: must be given only once");
    CHECK(placed_complaint_about_text(start + "], \"fog\": {}, \"materials\": {}}") ==
          "6:15: /fog: must have the key \"type\"\n6:19: /materials: must be given only once");
}

TEST_CASE("errors of a whole scene have a position") {
    const std::string camera = R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0],)";
    const auto complaint = placed_complaint_about_text;
    CHECK(complaint(camera + "\n \"up\": [0, 0, 1]}, \"objects\": []}") ==
          "2:8: /camera/up: must not be along the line of sight, got [0, 0, 1]");
    const std::string rest = "\"up\": [0, 1, 0]}, \"objects\": [],\n";
    CHECK(complaint(camera + rest + R"("image": {"width": 1, "height":0}})") ==
          "2:32: /image/height: must be from 1 to 65535, got 0");
    CHECK(complaint(camera + rest + R"("image": {"width": 65535, "height": 65535}})") ==
          "2:20: /image/width: must make at most 268435456 pixels, got 65535 x 65535");
    CHECK(complaint(camera + rest + R"("sampling": {"grid": 0}, "limits": {"min_weight": 2}})") ==
          "2:22: /sampling/grid: must be from 1 to 256, got 0\n"
          "2:51: /limits/min_weight: must be from 0 to 1, got 2");
    CHECK(complaint(camera + rest + R"("background": [0, -1, 0]})") ==
          "2:19: /background/1: must not be negative, got -1");
    CHECK(complaint(camera + rest + R"("fog": {"type": "linear", "start": 2, "end": 1}})") ==
          "2:46: /fog/end: must be more than start's 2, got 1");
    CHECK(complaint(camera + rest + R"("materials": {"a": {}, "b": {}, "a": {}}})") ==
          "2:33: /materials/a: must be given only once");
    CHECK(complaint(R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]}, "lights": [
        {"type": "point", "position": [9, 9, 9]},
        {"type": "point", "position": [0, 0, 1]}], "objects": [)" +
                    sphere("1", "{}") + "]}") ==
          "3:39: /lights/1/position: must not be on a surface, got a point of /objects/0");
}

TEST_CASE("up to ten errors are reported in the order of the file") {
    std::string objects, complaint;
    for (int i = 0; i < 10; ++i) {
        objects += (i == 0 ? "" : ",\n") + sphere("-1");
        complaint += (i == 0 ? "6:55" : "\n" + std::to_string(i + 6) + ":51") + ": /objects/" +
                     std::to_string(i) + "/radius: must be positive, got -1";
    }
    CHECK(complaint_about_objects(objects) == complaint);
    CHECK(complaint_about_objects(objects + ",\n" + sphere("1")) == complaint);
    const std::string more = complaint + "\n and more";
    CHECK(complaint_about_objects(objects + ",\n" + sphere("0")) == more);
    CHECK(complaint_about_objects(objects + ",\n" + sphere("?")) == more);
    CHECK(placed_complaint_about_text("{\"objects\": [" + sphere("0", "\"b\"") + ",\n" +
                                      sphere("2", "\"a\"") + ", " + sphere("3", "\"a\"") + ",\n" +
                                      sphere("4", "\"clay\"") +
                                      "],\n\"materials\": {\"clay\": 3}}") ==
          "1:1: must have the key \"camera\"\n"
          "1:1: /lights: must have at least one light if there are objects, or be [] for no "
          "lights, got none\n"
          "1:64: /objects/0/radius: must be positive, got 0\n"
          "1:79: /objects/0/material: must be the name of a material, got \"b\"\n"
          "2:66: /objects/1/material: must be the name of a material, got \"a\"\n"
          "4:23: /materials/clay: must be an object, got 3");
    CHECK(complaint_about_objects(sphere("-1") + ", {]") ==
          "6:55: /objects/0/radius: must be positive, got -1\n"
          "6:81: must be a key in double quotes, got ']'");
}

TEST_CASE("objects may come before the materials") {
    const std::string head = R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
        "lights": [{"type": "directional", "direction": [0, 0, 1]}], )";
    const std::string materials = R"("materials": {"a": {"ambient": 0}, "b": {"ambient": 0.25},
        "unused": {"ambient": 0.5}})";
    const std::string objects = R"("objects": [)" + sphere("1", R"({"ambient": 0.75})") + ", " +
                                sphere("2", R"("b")") + ", " + sphere("3", R"("a")") + ", " +
                                sphere("4", R"({"ambient": 1})") + ", " + sphere("5", R"("b")") +
                                "]";
    const core::Scene before = scene_of(head + materials + ", " + objects + "}");
    const core::Scene behind = scene_of(head + objects + ", " + materials + "}");
    for (const core::Scene* scene : {&before, &behind}) {
        CHECK(materials_of_shapes(*scene) == std::vector<core::MaterialIndex>{3, 1, 0, 4, 1});
        REQUIRE(scene->materials().size() == 5);
        const float ambient[] = {0.0F, 0.25F, 0.5F, 0.75F, 1.0F};
        for (int i = 0; i < 5; ++i)
            CHECK(scene->materials()[static_cast<std::size_t>(i)].ambient == ambient[i]);
    }
}

TEST_CASE("Errors that follow from a misspelt root key are not reported") {
    const std::string camera = R"("camera": {"from": [0, 0, 5], "at": [0, 0, 0]})";
    const std::string lights = R"("lights": [{"type": "directional", "direction": [0, 0, 1]}])";
    const std::string materials = R"("materials": {"clay": {}})";
    const std::string balls = R"("objects": [)" + sphere("1") + ", " + sphere("2") + "]";
    const auto complaint = [&](const std::vector<std::string>& items) {
        std::string text;
        for (const std::string& item : items)
            text += (text.empty() ? "{" : ", ") + item;
        return complaint_about_text(text + "}");
    };
    const auto with_suggestion = [](const std::string& key, const std::string& meant) {
        return "unknown key \"" + key + "\", did you mean \"" + meant + "\"?";
    };
    CHECK(complaint({R"("Camera": {})", lights, materials, balls}) ==
          with_suggestion("Camera", "camera"));
    CHECK(complaint({camera, R"("light": [])", materials, balls}) ==
          with_suggestion("light", "lights"));
    CHECK(complaint({camera, lights, R"("material": {"clay": {}})", balls}) ==
          with_suggestion("material", "materials"));
    CHECK(complaint({camera, lights, balls, R"("material": {"clay": {}})"}) ==
          with_suggestion("material", "materials"));
    CHECK(complaint({camera, lights, materials, R"("materials": {"iron": {}})",
                     R"("objects": [)" + sphere("1", "\"iron\"") + "]"}) ==
          "/materials: must be given only once");
    CHECK(complaint({camera, lights, R"("materials": [])", balls}) ==
          "/materials: must be an object, got an array");
    CHECK(complaint({camera, lights, materials, R"("object": [])"}) ==
          with_suggestion("object", "objects"));
    const std::string instances =
        R"("objects": [{"type": "instance", "of": "d"}, {"type": "instance", "of": "e"}])";
    CHECK(complaint({camera, lights, materials, R"("definition": {})", instances}) ==
          with_suggestion("definition", "definitions"));
    CHECK(complaint({camera, lights, materials, R"("includes": [])", instances}) ==
          with_suggestion("includes", "include"));
    const std::string by_parameter =
        R"("objects": [)" + sphere("\"$r\"") + ", " + sphere("\"-$r\"") + "]";
    const std::string parameter = R"("parameter": {"r": 1})";
    CHECK(complaint({camera, lights, materials, parameter, by_parameter}) ==
          with_suggestion("parameter", "parameters"));
    CHECK(complaint({camera, lights, materials, by_parameter, parameter}) ==
          with_suggestion("parameter", "parameters"));
    CHECK(complaint({camera, lights, materials, by_parameter}) ==
          "/objects/0/radius: must have a value, by \"parameters\" or --set, got \"$r\"");
    CHECK(complaint({camera, lights, materials, by_parameter, R"("parameters": {"r": "one"})"}) ==
          "/parameters/r: must be a number, got \"one\"");
    // Independent errors are reported.
    CHECK(complaint({camera, R"("material": {})", balls}) ==
          "/lights: must have at least one light if there are objects, or be [] for no lights, got "
          "none\n" +
              with_suggestion("material", "materials"));
}

TEST_CASE("A mistake is reported where it is and not where it is used") {
    const std::string use = R"({"type": "instance", "of": "d"})";
    const std::string solid = R"({"type": "union", "material": "clay", "objects": [)";
    const std::string defined = R"("definitions": {"d": )";
    const auto complaint = [](const std::string& definitions, const std::string& objects) {
        return complaint_about_text(R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
            "lights": [], "materials": {"clay": {}}, )" +
                                    definitions + R"(, "objects": [)" + objects + "]}");
    };
    CHECK(complaint(defined + sphere("-1") + "}",
                    use + ", " + use + ", " + solid + use + ", " + use + "]}") ==
          "/definitions/d/radius: must be positive, got -1");
    CHECK(complaint(defined + sphere("-1") + R"(, "e": )" + use + "}",
                    R"({"type": "instance", "of": "e"})") ==
          "/definitions/d/radius: must be positive, got -1");
    CHECK(complaint(R"("definitions": {})", use + ", " + use) ==
          "/objects/0/of: must be the name of an earlier definition, got \"d\"");
    const std::string placed = R"({"type": "instance", "of": "d", "placements": []})";
    CHECK(complaint(defined + sphere("1") + "}", solid + placed + "]}") ==
          "/objects/0/objects/0/placements: goes with an instance that is an object of the scene "
          "itself");
    CHECK(complaint(R"("parameters": {"r": "x"})", sphere("\"$r\"") + ", " + sphere("\"-$r\"")) ==
          "/parameters/r: must be a number, got \"x\"");
    CHECK(
        complaint(R"("parameters": {"r": "x"})", sphere("\"$r\"") + ", " + sphere("-1")) ==
        "/parameters/r: must be a number, got \"x\"\n/objects/1/radius: must be positive, got -1");
    CHECK(complaint_about_text(R"({"camera": {"type": "auto", "zoom": -1},
        "materials": {"clay": {}}, "objects": [)" +
                               sphere("1") + "]}") ==
          "/camera/zoom: must be from 0.01 to 1000, got -1");
}
