#include "scenes/formats/scene_file.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <fstream>
#include <map>
#include <sys/stat.h>
#include <thread>

using namespace raylane;
using namespace raylane::tests;

namespace {

/// Returns a scene with a ball of this radius, with `keys` at the end of the root object.
std::string ball_of_radius(const std::string& radius, const std::string& keys = "") {
    std::string text = with_objects(
        R"({"type": "sphere", "material": "clay", "center": [0, 0, "-$x"], "radius": )" + radius +
        "}");
    text.pop_back();
    return text + (keys.empty() ? "" : ", " + keys) + "}";
}

core::Scene set(const std::string& text, const std::map<std::string, double>& parameters) {
    scenes::InputFile file("scene.json", text);
    return scenes::read_json(file, nullptr, parameters);
}

core::SphereOf<double> ball(const core::Scene& scene) {
    return shape<core::Sphere>(scene, 0);
}

std::string complaint(const std::string& text, const std::map<std::string, double>& parameters) {
    try {
        static_cast<void>(set(text, parameters));
    } catch (const scenes::BadInput& bad) {
        return bad.what();
    }
    return "";
}

} // namespace

TEST_CASE("a parameter has its value from the command line or the default of the file") {
    const std::string defaults = R"("parameters": {"r": 0.1, "x": 3})";
    const std::string text = ball_of_radius(R"("$r")", defaults);
    CHECK(ball(set(text, {})).radius == 0.1);
    CHECK(ball(set(text, {})).center.z == -3.0);
    CHECK(ball(set(text, {{"r", 0.3}})).radius == 0.3);
    CHECK(ball(set(text, {{"r", 0.3}})).center.z == -3.0);
    // Parameters may also come before their uses, and need no default.
    std::string before = text;
    before = "{" + defaults + ", " + ball_of_radius(R"("$r")").substr(1);
    CHECK(ball(set(before, {})).radius == 0.1);
    CHECK(ball(set(ball_of_radius(R"("$r")"), {{"r", 2.0}, {"x", 1.0}})).radius == 2.0);
    // The value has the same bits as the number.
    CHECK(ball(set(text, {{"r", 1.0 / 3.0}})).radius == 1.0 / 3.0);
}

TEST_CASE("a formula's parameters have their values, also from later in the file") {
    const auto texts = [](const std::map<std::string, double>& parameters) {
        const core::Scene scene = set(R"({"camera": {"from": [0, 0, 9], "at": [0, 0, 0]},
            "materials": {"a": {"pattern": {"type": "formula", "color": ["$low * x", "y", "$high_2"]}}},
            "lights": [], "objects": [], "parameters": {"low": -0.25, "high_2": 0.1}})",
                                      parameters);
        return scene.materials()[0].pattern.formula.texts();
    };
    CHECK(texts({}) == core::FormulaTexts{"(-0.25) * x", "y", "0.1"});
    CHECK(texts({{"low", 1.0 / 3.0}}) == core::FormulaTexts{"0.3333333333333333 * x", "y", "0.1"});
}

TEST_CASE("a parameter without a value or without a use is an error") {
    CHECK(
        complaint(ball_of_radius("1"), {}) ==
        "scene.json:4:84: /objects/0/center/2: must have a value, by \"parameters\" or --set, got "
        "\"-$x\"");
    CHECK(complaint(ball_of_radius(R"("$radius")", R"("parameters": {"x": 1, "raduis": 1})"), {})
              .find("did you mean \"$raduis\"?") != std::string::npos);
    CHECK(complaint(ball_of_radius("1"), {{"x", 1.0}, {"y", 1.0}}) ==
          "scene.json: has no parameter \"$y\", did you mean \"$x\"?");
    CHECK(complaint(ball_of_radius(R"("$r")"), {{"x", 1.0}, {"r", -1.0}})
              .find("/objects/0/radius: must be positive, got -1") != std::string::npos);
    CHECK(complaint(ball_of_radius(R"("$1")"), {{"x", 1.0}})
              .find("letters, digits and underscores") != std::string::npos);
    CHECK(complaint(ball_of_radius("1", R"("parameters": {"x": "one"})"), {})
              .find("/parameters/x: must be a number, got \"one\"") != std::string::npos);
    // Errors elsewhere are still reported.
    CHECK(complaint(ball_of_radius("0", R"("parameters": {"x": 1})"), {})
              .find("must be positive, got 0") != std::string::npos);
}

TEST_CASE("the first value of a parameter counts and a second one in the same file is an error") {
    CHECK(complaint(ball_of_radius(R"("$r")", R"("parameters": {"x": 1, "r": 1, "r": 2})"), {})
              .find("/parameters/r: must be given only once") != std::string::npos);
    CHECK(complaint(ball_of_radius("1", R"("parameters": {"x": "$x"})"), {})
              .find("/parameters/x: must have a value") != std::string::npos);
    CHECK(complaint(ball_of_radius("1", R"("parameters": {"x": 1e31})"), {})
              .find("/parameters/x: must be a number from -1e30 to 1e30") != std::string::npos);
    CHECK(ball(set(ball_of_radius(R"("$r")", R"("parameters": {"x": 1, "y": -3, "r": "-$y"})"), {}))
              .radius == 3.0);

    const TemporaryDirectory directory;
    directory.write("numbers.json", R"({"parameters": {"r": 2, "x": 5}})");
    const auto radius = [&](const std::string& keys) {
        return ball(scenes::load_scene(
                        directory.write("scene.json", ball_of_radius(R"("$r")", keys))))
            .radius;
    };
    const std::string include = R"("include": ["numbers.json"])", own = R"("parameters": {"r": 3})";
    // Both come behind the uses of the parameter.
    CHECK(radius(include) == 2.0);
    CHECK(radius(include + ", " + own) == 2.0);
    CHECK(radius(own + ", " + include) == 3.0);
}

TEST_CASE("an error behind a late parameter of an included file has its position") {
    const TemporaryDirectory directory;
    directory.write("numbers.json",
                    "{\"parameters\": {\"r\": 2, \"x\": 5}, \"include\": [\"scene.json\"]}");
    const auto path =
        directory.write("scene.json", ball_of_radius(R"("$r")", R"("include": ["numbers.json"])"));
    CHECK(message_of<scenes::BadInput>([&] { static_cast<void>(scenes::load_scene(path)); }) ==
          (directory.path() / "numbers.json").string() +
              ":1:46: /include/0: must not include a file that includes it, got \"scene.json\"");
}

TEST_CASE("a parameter behind its use is refused in a pipe") {
    const TemporaryDirectory directory;
    const std::filesystem::path pipe = directory.path() / "pipe.json";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const auto complaint_about = [&](const std::string& text) {
        const std::jthread writer([&] { std::ofstream(pipe) << text; });
        return message_of<scenes::BadInput>([&] { static_cast<void>(scenes::load_scene(pipe)); });
    };
    const std::string numbers = R"("parameters": {"r": 2, "x": 5})";
    CHECK(complaint_about(ball_of_radius(R"("$r")", numbers))
              .ends_with("got \"-$x\"; in a pipe, it must come before its use"));
    CHECK(complaint_about("{" + numbers + ", " + ball_of_radius(R"("$r")").substr(1)) ==
          "no error");
}

TEST_CASE("parameters are for scenes in JSON") {
    CHECK(message_of<scenes::BadInput>([&] {
              static_cast<void>(
                  scenes::parse_scene("water.xyz", "1\n\nO 0 0 0\n", {.parameters = {{"n", 1.0}}}));
          }).find("only JSON scenes have parameters") != std::string::npos);
}

TEST_CASE("included files are relative to the including file") {
    const TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "parts");
    directory.write("parts/materials.json",
                    R"({"materials": {"red": {"color": [1, 0, 0]}}, "parameters": {"r": 2}})");
    directory.write("parts/ball.json", R"({"include": ["materials.json"], "camera": "auto",
        "lights": [{"type": "point", "position": [0, 9, 0]}],
        "objects": [{"type": "sphere", "material": "red", "center": [0, 0, 0], "radius": "$r"}]})");
    const auto scene_with = [&](const std::string& includes) {
        return directory.write("scene.json", R"({"include": [)" + includes + R"(],
            "camera": {"from": [0, 0, 9], "at": [0, 0, 0]},
            "objects": [{"type": "sphere", "material": "red", "center": [3, 0, 0], "radius": 1}]})");
    };
    const core::Scene scene =
        scenes::load_scene(scene_with(R"("parts/ball.json", "parts/materials.json")"));
    CHECK(scene.shape_count() == 2);
    CHECK(ball(scene).radius == 2.0);
    CHECK(scene.lights().size() == 1);
    // The camera is that of the including file.
    CHECK(scene.camera().from == core::Vec3f(0, 0, 9));
    CHECK(scene.material_of(1).pattern.colors[0] == core::Color(1, 0, 0));

    const auto complaint_about = [&](const std::filesystem::path& path) {
        return message_of<scenes::BadInput>([&] { static_cast<void>(scenes::load_scene(path)); });
    };
    const std::string name = (directory.path() / "scene.json").string();
    CHECK(complaint_about(scene_with(R"("nowhere.json")"))
              .starts_with(name + ":1:14: /include/0: must be the name of a file, got "
                                  "\"nowhere.json\""));
    CHECK(complaint_about(scene_with(R"("scene.json")")) ==
          name + ":1:14: /include/0: must not include a file that includes it, got \"scene.json\"");
    directory.write("parts/wrong.json", R"({"materials": {"red": {"colour": 1}}})");
    CHECK(complaint_about(scene_with(R"("parts/wrong.json")"))
              .starts_with((directory.path() / "parts/wrong.json").string() +
                           ":1:24: /materials/red: unknown key \"colour\""));
    for (int i = 0; i < 20; ++i)
        directory.write(std::to_string(i) + ".json",
                        R"({"include": [")" + std::to_string(i + 1) + R"(.json"]})");
    CHECK(complaint_about(scene_with(R"("0.json")")).find("more than 16 deep") !=
          std::string::npos);
}

TEST_CASE("materials of one name in several files are several materials") {
    const TemporaryDirectory directory;
    const auto ball = [](const std::string& x) {
        return R"("objects": [{"type": "sphere", "material": "C", "radius": 1, "center": [)" + x +
               ", 0, 0]}]";
    };
    const auto color = [](const std::string& rgb) {
        return R"("materials": {"C": {"color": [)" + rgb + "]}}";
    };
    directory.write("red.json", "{" + color("1, 0, 0") + ", " + ball("0") + "}");
    directory.write("green.json", "{" + color("0, 1, 0") + ", " + ball("3") + "}");
    directory.write("none.json", "{" + ball("6") + "}");
    const auto scene_with = [&](const std::string& own) {
        return scenes::load_scene(directory.write("scene.json", R"({"camera": "auto",
            "include": ["red.json", "green.json", "none.json"], )" + own +
                                                                    "}"));
    };
    const auto colors = [](const core::Scene& scene) {
        std::string text;
        for (core::ShapeId id = 0; id < scene.shape_count(); ++id) {
            const core::Color resolved = scene.material_of(id).pattern.colors[0];
            text += resolved.x > 0.0F ? "r" : resolved.y > 0.0F ? "g" : "b";
        }
        return text;
    };
    // A file without a material of the name uses the first one.
    CHECK(colors(scene_with(ball("9"))) == "rgrr");
    const core::Scene scene = scene_with(color("0, 0, 1") + ", " + ball("9"));
    CHECK(colors(scene) == "rgrb");
    CHECK(scene.material_name(scene.material_index_of(0)) == "C");
    CHECK(scene.material_name(scene.material_index_of(1)) == "C-2");
    CHECK(scene.material_name(scene.material_index_of(3)) == "C-3");
    CHECK(message_of<scenes::BadInput>([&] { scene_with(ball("9") + ", " + color("0, 0, 1")); })
              .find("/materials/C: must come before the objects that use it, because another file "
                    "has a material of this name") != std::string::npos);
}

TEST_CASE("a light on a surface is reported with its file and the object's file") {
    const TemporaryDirectory directory;
    directory.write("balls.json", R"({"objects": [
        {"type": "sphere", "material": {}, "center": [9, 0, 0], "radius": 1},
        {"type": "sphere", "material": {}, "center": [0, 0, 0], "radius": 1}]})");
    const auto path =
        directory.write("scene.json", R"({"camera": {"from": [0, 0, 9], "at": [0, 0, 0]},
        "objects": [{"type": "sphere", "material": {}, "center": [0, 5, 0], "radius": 1}],
        "include": ["balls.json"],
        "lights": [{"type": "point", "position": [0, 0, 1]}]})");
    const std::string message =
        message_of<scenes::BadInput>([&] { static_cast<void>(scenes::load_scene(path)); });
    CHECK(message.find("/lights/0/position: must not be on a surface, got a point of " +
                       (directory.path() / "balls.json").string() + ": /objects/1") !=
          std::string::npos);
}

TEST_CASE("a preset gives the values that a material's other keys do not") {
    const auto material = [](const std::string& keys) {
        return scene_of(with_objects(R"({"type": "sphere", "center": [0, 0, 0], "radius": 1,
                                         "material": {)" +
                                     keys + "}}"))
            .material_of(0);
    };
    CHECK(material(R"("preset": "glass")").transmission == 1.0F);
    CHECK(material(R"("preset": "glass")").index == 1.5F);
    CHECK(material(R"("index": 1.7, "preset": "glass")").index == 1.7F);
    CHECK(material(R"("preset": "glass", "color": "#ff0000")").pattern.colors[0].x == 1.0F);
    CHECK(material(R"("preset": "plastic")").reflection == core::Reflection::dielectric);
    CHECK(material(R"("preset": "plastic", "reflectivity": 0.5)").reflection ==
          core::Reflection::constant);
    CHECK(material(R"("preset": "mirror")").reflectivity == 0.95F);
    CHECK(material(R"("preset": "matte")").diffuse == material("").diffuse);
}

TEST_CASE("a camera of type auto brings lights if the scene has no list of them") {
    const std::string objects =
        R"("objects": [{"type": "sphere", "material": {}, "center": [5, 0, 0], "radius": 1}])";
    const core::Scene scene = scene_of(R"({"camera": "auto", )" + objects + "}");
    CHECK(scene.camera().at.x == 5.0F);
    CHECK(scene.lights().size() == 2);
    const core::Scene other = scene_of(
        R"({"camera": {"type": "auto", "view": "x", "orthographic": true, "zoom": 2},
            "lights": [{"type": "directional", "direction": [0, -1, 0]}], )" +
        objects + "}");
    CHECK(other.lights().size() == 1);
    CHECK(other.camera().projection == core::Projection::orthographic);
    CHECK(other.camera().from.x > 6.0F);
    CHECK(other.camera().height < 1.2F);
    CHECK(complaint_about_text(R"({"camera": "auto", "objects": []})") ==
          "/camera: must have a bounded shape to frame, got none");
}
