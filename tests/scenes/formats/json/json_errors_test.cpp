#include "core/kinds.hpp"
#include "scenes/formats/json/object.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <filesystem>
#include <vector>

using namespace raylane;
using namespace raylane::tests;

namespace {

struct Case {
    std::string text;
    std::string complaint;
};

void check(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        INFO(c.text);
        CHECK(complaint_about_text(c.text) == c.complaint);
    }
}

const std::string camera = R"("camera": {"from": [0, 0, 50], "at": [0, 0, 0]})";

/// Returns a scene without objects and with another key.
std::string with(const std::string& member) {
    return "{" + camera + R"(, "objects": [], )" + member + "}";
}

std::string with_camera(const std::string& keys) {
    return R"({"objects": [], "camera": {)" + keys + "}}";
}

/// Returns the names of all types of objects, as an error lists them.
std::string type_names() {
    std::string names;
    for (int kind = 0; kind < core::kind_count; ++kind) {
        std::string name("\"");
        name.append(core::type_name_of(static_cast<core::Kind>(kind))).append("\", ");
        if (names.find(name) == std::string::npos) names += name;
    }
    return names +
           R"("sphereflake", "lattice", "union", "intersection", "difference", "clip", "lens", "group" or "instance")";
}

/// Returns a scene with a clay object of this type at /objects/1.
std::string object(const std::string& type, const std::string& keys) {
    return with_objects(R"({"type": "sphere", "material": "clay", "center": [9, 9, 9], "radius": 1},
        {"type": ")" + type +
                        R"(", "material": "clay")" + (keys.empty() ? "" : ", ") + keys + "}");
}

std::string material(const std::string& keys) {
    return with(R"("materials": {"a/b~": {)" + keys + "}}");
}

std::string pattern(const std::string& keys) {
    return material(R"("pattern": {)" + keys + "}");
}

} // namespace

TEST_CASE("a missing file and a directory are reported") {
    const TemporaryFile file("");
    std::filesystem::path gone = file.path();
    gone += ".gone";
    CHECK(complaint_about(gone) == "no such file");
    CHECK(complaint_about(std::filesystem::temp_directory_path()) ==
          "must be a file, got a directory");
}

TEST_CASE("unknown and missing and repeated keys are reported") {
    check({
        {"{}", "must have the key \"camera\"\nmust have the key \"objects\""},
        {"{" + camera + "}", R"(must have the key "objects")"},
        {with(R"("light": [])"), R"(unknown key "light", did you mean "lights"?)"},
        {with(R"("zzzzzzzz": [])"),
         R"(unknown key "zzzzzzzz", must be "$schema", "parameters", "include", "image", "sampling", "limits", "outline", "camera", "background", "fog", "spectrum", "lights", "materials", "definitions" or "objects")"},
        {with(R"("objects": [])"), "/objects: must be given only once"},
        {with(R"("image": {"width": 1, "width": 2})"), "/image/width: must be given only once"},
        {with(R"("materials": {"a": {}, "a": {}})"), "/materials/a: must be given only once"},
        {object("sphere", R"("center": [0, 0, 0], "raduis": 1)"),
         R"(/objects/1: unknown key "raduis", did you mean "radius"?)"},
        {object("sphere", R"("center": [0, 0, 0], "normal": 1)"),
         R"(/objects/1: unknown key "normal", must be "type", "material", "center", "radius", "scale", "rotate", "translate" or "transform")"},
        {object("sphere", R"("center": [0, 0, 0])"), R"(/objects/1: must have the key "radius")"},
        {with_objects(R"({"type": "sphere", "center": [0, 0, 0], "radius": 1})"),
         R"(/objects/0: must have the key "material")"},
        {with_objects(R"({"material": "clay"})"), R"(/objects/0: must have the key "type")"},
        {with_camera(R"("from": [0, 0, 1])"), R"(/camera: must have the key "at")"},
        {with_camera(R"("from": [0, 0, 1], "at": [0, 0, 0], "height": 1)"),
         R"(/camera: unknown key "height", must be "type", "from", "at", "up", "field_of_view", "lens_radius" or "focus_distance")"},
        {with_camera(R"("type": "orthographic", "from": [0, 0, 1], "at": [0, 0, 0])"),
         R"(/camera: must have the key "height")"},
        {with(R"("fog": {"type": "linear", "start": 0})"), R"(/fog: must have the key "end")"},
        {with(R"("fog": {"type": "linear", "start": 0, "end": 1, "density": 1})"),
         R"(/fog: unknown key "density", must be "type", "color", "start" or "end")"},
        {with(R"("lights": [{"type": "point"}])"), R"(/lights/0: must have the key "position")"},
        {material(R"("colour": [1, 1, 1])"),
         R"(/materials/a~1b~0: unknown key "colour", did you mean "color"?)"},
        {material(R"("color": [1, 1, 1], "pattern": {"type": "back-plane"})"),
         R"(/materials/a~1b~0: must not have both "color" and "pattern")"},
        {material(R"("reflectivity": 1, "reflection": "schlick")"),
         R"(/materials/a~1b~0: must not have both "reflectivity" and "reflection")"},
        {pattern(R"("type": "formula")"),
         R"(/materials/a~1b~0/pattern: must have the key "color")"},
        {pattern(R"("type": "formula", "color": ["x", "y"])"),
         "/materials/a~1b~0/pattern/color: must be an array of 3 formulas, got 2"},
        {pattern(R"("type": "formula", "color": ["x", "y", []])"),
         "/materials/a~1b~0/pattern/color/2: must be a string, got an array"},
        {pattern(R"("type": "formula", "color": ["x", "y", "\n z +"])"),
         "/materials/a~1b~0/pattern/color/2: must be a formula: line 2, column 5: expected a "
         "number, a name or \"(\", got the end"},
        {pattern(R"("type": "formula", "color": ["x", "$low + 1", "0"])"),
         "/materials/a~1b~0/pattern/color/1: must have a value, by \"parameters\" or --set, got "
         "\"$low\""},
        // A determinant of doubles that is not 0, but too small for an inverse in doubles.
        {pattern(R"("type": "formula", "color": ["x", "y", "z"], "transform": [[0.5, 0.3, 0.36, 0],
                    [0.30000000000000004, 2.0999999999999996, 1.5599999999999998, 0],
                    [0.9, 0.2, 0.41000000000000003, 0]])"),
         "/materials/a~1b~0/pattern: must have a transform with an inverse whose numbers doubles "
         "can hold"},
        {pattern(R"("type": "back-plane", "color": "#ffffff")"),
         R"(/materials/a~1b~0/pattern: unknown key "color", must be "type")"},
        {with(R"("camera\u0000\n": 1)"), R"(unknown key "camera\x00\x0A", did you mean "camera"?)"},
    });
}

TEST_CASE("errors in solids name the shape and instances have a limit") {
    const std::string ball = R"({"type": "sphere", "center": [0, 0, 0], "radius": 1})";
    const std::string flat = R"({"type": "sphere", "center": [0, 0, 0], "radius": -1})";
    check({
        {with_objects(R"({"type": "group", "material": "clay", "objects": [)" + ball + ", " + flat +
                      "]}"),
         "/objects/0/objects/1/radius: must be positive, got -1"},
        {with_objects(
             R"({"type": "union", "material": "clay", "objects": [{"type": "group", "objects": [)" +
             flat + "]}]}"),
         "/objects/0/objects/0/objects/0/radius: must be positive, got -1"},
        {with_objects(
             R"({"type": "union", "material": "clay", "objects": [{"type": "quadric", "matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, -1]]}]})"),
         "/objects/0: must be bounded, got an unbounded quadric: intersect it with a box"},
    });
    std::string twice = R"("definitions": {"0": )" + ball;
    std::string deep = twice;
    for (int i = 1; i < 22; ++i) {
        const std::string definition =
            R"({"type": "instance", "of": ")" + std::to_string(i - 1) + "\"}";
        twice += ", \"" + std::to_string(i) + R"(": {"type": "union", "objects": [)" + definition +
                 ", " + definition + "]}";
    }
    for (int i = 1; i < 257; ++i)
        deep += ", \"" + std::to_string(i) +
                R"(": {"type": "union", "objects": [{"type": "instance", "of": ")" +
                std::to_string(i - 1) + "\"}]}";
    check({
        {with(twice + "}"), "/definitions/20/objects/0/of: must not expand to more than 1048576 "
                            "shapes in one object, or in all definitions"},
        {with(deep + "}"), "/definitions/256: must not have solids nested more than 256 deep"},
    });
}

TEST_CASE("shapes of instances and generators have a limit for the whole scene") {
    scenes::Parameters parameters;
    scenes::JsonDocument document(parameters);
    document.begin("scene.json", "/objects/7");
    document.add(scenes::JsonType::number, {}, "", "8", 8.0);
    scenes::Definitions definitions;
    definitions.count(scenes::Definitions::max_requested, document.root());
    CHECK(message_of<scenes::BadInput>([&] { definitions.count(1, document.root()); })
              .ends_with("/objects/7: must not expand to more than 67108864 shapes of instances, "
                         "lattices and sphereflakes in one scene"));
}

TEST_CASE("values of a wrong JSON type are reported") {
    check({
        {"[]", "must be an object, got an array"},
        {"\"scene\"", "must be an object, got \"scene\""},
        {with(R"("lights": {})"), "/lights: must be an array, got an object"},
        {with(R"("lights": [3])"), "/lights/0: must be an object, got 3"},
        {with(R"("materials": [])"), "/materials: must be an object, got an array"},
        {with(R"("materials": {"a": "red"})"), "/materials/a: must be an object, got \"red\""},
        {with(R"("fog": null)"), "/fog: must be an object, got null"},
        {with(R"("$schema": 1)"), "/$schema: must be a string, got 1"},
        {object("sphere", R"("center": [0, 0, 0], "radius": "1")"),
         "/objects/1/radius: must be a number, got \"1\""},
        {object("sphere", R"("center": [0, 0], "radius": 1)"),
         "/objects/1/center: must be an array of 3 numbers, got 2"},
        {object("sphere", R"("center": 0, "radius": 1)"),
         "/objects/1/center: must be an array of 3 numbers, got 0"},
        {object("sphere", R"("center": [0, 0, true], "radius": 1)"),
         "/objects/1/center/2: must be a number, got true"},
        {object("cylinder", R"("base": [0, 0, 0], "axis": [0, 0, 1], "radius": 1, "capped": 1)"),
         "/objects/1/capped: must be true or false, got 1"},
        {with_objects(R"({"type": 1, "material": "clay"})"),
         "/objects/0/type: must be a string, got 1"},
        {with_objects(R"({"type": "sphere", "material": 1, "center": [0, 0, 0], "radius": 1})"),
         "/objects/0/material: must be the name of a material, or a material, got 1"},
        {with(R"("image": {"width": 4.5})"), "/image/width: must be a whole number, got 4.5"},
        {with(R"("image": {"width": "4"})"), "/image/width: must be a whole number, got \"4\""},
        {with(R"("image": {"width": 1e12})"),
         "/image/width: must be a whole number of at most 2147483647, got 1e12"},
        {with(R"("background": "red")"),
         R"(/background: must be [red, green, blue] or "#rrggbb", got "red")"},
        {with(R"("background": "#12345g")"),
         R"(/background: must be [red, green, blue] or "#rrggbb", got "#12345g")"},
        {with(R"("background": "#1234567")"),
         R"(/background: must be [red, green, blue] or "#rrggbb", got "#1234567")"},
        {with(R"("background": 1)"),
         R"(/background: must be [red, green, blue] or "#rrggbb", got 1)"},
    });
}

TEST_CASE("unknown words are reported with the known ones") {
    check({
        {object("spher", ""),
         "/objects/1/type: must be " + type_names() + R"(, got "spher", did you mean "sphere"?)"},
        {with_objects(
             R"({"type": "sphere", "material": "caly", "center": [0, 0, 0], "radius": 1})"),
         R"(/objects/0/material: must be the name of a material, got "caly", did you mean "clay"?)"},
        {with_objects(
             R"({"type": "sphere", "material": "obsidian", "center": [0, 0, 0], "radius": 1})"),
         R"(/objects/0/material: must be the name of a material, got "obsidian")"},
        {"{" + camera +
             R"(, "lights": [{"type": "directional", "direction": [0, 0, 1]}], "objects": [{"type": "sphere", "material": "clay", "center": [0, 0, 0], "radius": 1}]})",
         R"(/objects/0/material: must be the name of a material, got "clay")"},
        {with(R"("image": {"alpha": 1})"), "/image/alpha: must be true or false, got 1"},
        {with(R"("image": {"transfer": "sRGB"})"),
         R"(/image/transfer: must be "srgb" or "linear", got "sRGB")"},
        {with(R"("sampling": {"pattern": "random"})"),
         R"(/sampling/pattern: must be "regular" or "stratified", got "random")"},
        {with_camera(R"("type": "fisheye")"),
         R"(/camera/type: must be "perspective", "orthographic" or "auto", got "fisheye")"},
        {with(R"("fog": {"type": "liner"})"),
         R"(/fog/type: must be "linear-z", "linear" or "exponential", got "liner", did you mean "linear"?)"},
        {with(R"("lights": [{"type": "sun"}])"),
         R"(/lights/0/type: must be "point", "directional", "sky", "sphere", "disc", "rectangle" or "camera", got "sun")"},
        {pattern(R"("type": "chekcer")"),
         R"(/materials/a~1b~0/pattern/type: must be "checker", "stripes", "gradient", "formula", "image", "cutaway" or "back-plane", got "chekcer", did you mean "checker"?)"},
        {pattern(R"("type": "checker", "colors": ["#000000", "#ffffff"], "size": 1, "axes": "zx")"),
         R"(/materials/a~1b~0/pattern/axes: must be "x", "y", "z", "xy", "xz", "yz" or "xyz", got "zx", did you mean "x"?)"},
        {material(R"("reflection": "constant")"),
         R"(/materials/a~1b~0/reflection: must be "schlick" or "dielectric", got "constant")"},
        {material(R"("visible": "none")"),
         R"(/materials/a~1b~0/visible: must be "both", "outside" or "inside", got "none")"},
    });
}

TEST_CASE("numbers out of range are reported") {
    check({
        {object("sphere", R"("center": [0, 0, 0], "radius": 1e39)"),
         "/objects/1/radius: must be a number from -1e30 to 1e30, got 1e+39"},
        {object("sphere", R"("center": [0, -1e999, 0], "radius": 1)"),
         "/objects/1/center/1: must be a number from -1e30 to 1e30, got -1e999"},
        {object("sphere", R"("center": [0, 2e30, 0], "radius": 1)"),
         "/objects/1/center/1: must be a number from -1e30 to 1e30, got 2e+30"},
        {object("sphere", R"("center": [0, 0, 0], "radius": 1e-60)"),
         "/objects/1/radius: must be positive, got 0, the float nearest to 1e-60"},
        {object("sphere", R"("center": [0, 0, 0], "radius": 0)"),
         "/objects/1/radius: must be positive, got 0"},
        {object("sphere", R"("center": [0, 0, 0], "radius": -1)"),
         "/objects/1/radius: must be positive, got -1"},
        {with(R"("image": {"width": 0})"), "/image/width: must be from 1 to 65535, got 0"},
        {with(R"("image": {"height": -3})"), "/image/height: must be from 1 to 65535, got -3"},
        {with(R"("image": {"width": 65535, "height": 65535})"),
         "/image/width: must make at most 268435456 pixels, got 65535 x 65535"},
        {with(R"("sampling": {"grid": 0})"), "/sampling/grid: must be from 1 to 256, got 0"},
        {with(R"("limits": {"max_depth": -1})"),
         "/limits/max_depth: must be from 0 to 1000, got -1"},
        {with(R"("limits": {"min_weight": 1.5})"),
         "/limits/min_weight: must be from 0 to 1, got 1.5"},
        {with(R"("outline": {"width": 33})"),
         "/outline/width: must be between 0 and 32 pixels, got 33"},
        {with(R"("outline": {"width": 1, "color": [0, -1, 0]})"),
         "/outline/color/1: must not be negative, got -1"},
        {with(R"("outline": {"width": 1, "creases": 181})"),
         "/outline/creases: must be between 0 and 180 degrees, got 181"},
        {with(R"("background": [0, -0.5, 0])"), "/background/1: must not be negative, got -0.5"},
        {material(R"("color": [0, 0, -2])"),
         "/materials/a~1b~0/color/2: must not be negative, got -2"},
        {material(R"("index": 0)"), "/materials/a~1b~0/index: must be positive, got 0"},
        {material(R"("reflectivity": 2)"),
         "/materials/a~1b~0/reflectivity: must be from 0 to 1, got 2"},
        {material(R"("transmission": -1)"),
         "/materials/a~1b~0/transmission: must be from 0 to 1, got -1"},
        {material(R"("absorption": [0, -1, 0])"),
         "/materials/a~1b~0/absorption/1: must not be negative, got -1"},
        {pattern(R"("type": "checker", "colors": ["#000000", [0, 0, -1]], "size": 1)"),
         "/materials/a~1b~0/pattern/colors/1/2: must not be negative, got -1"},
        {pattern(R"("type": "checker", "colors": ["#000000", "#ffffff"], "size": 0)"),
         "/materials/a~1b~0/pattern/size: must be positive, got 0"},
        {pattern(R"("type": "stripes", "colors": ["#000000", "#ffffff"], "width": 0)"),
         "/materials/a~1b~0/pattern/width: must be positive, got 0"},
        {pattern(R"("type": "checker", "colors": ["#000000"], "size": 1)"),
         "/materials/a~1b~0/pattern/colors: must be an array of 2 colors, got 1"},
        {object("sphereflake", R"("center": [0, 0, 0], "radius": 1, "depth": 9)"),
         "/objects/1/depth: must be from 0 to 8, got 9"},
        {object(
             "lattice",
             R"("corner": [0, 0, 0], "n": 0, "spacing": 1, "sphere_radius": 1, "strut_radius": 1)"),
         "/objects/1/n: must be from 1 to 256, got 0"},
    });
}

TEST_CASE("degenerate geometry is reported") {
    check({
        {object("cylinder", R"("base": [0, 0, 0], "axis": [0, 0, 0], "radius": 1)"),
         "/objects/1/axis: must not be the zero vector, got [0, 0, 0]"},
        {object("cone", R"("base": [0, 0, 0], "axis": [0, 1, 0], "base_radius": 0)"),
         "/objects/1/base_radius: must be positive if top_radius is 0, got 0"},
        {object("plane", R"("point": [0, 0, 0], "normal": [0, 0, 0])"),
         "/objects/1/normal: must not be the zero vector, got [0, 0, 0]"},
        {object("triangle", R"("a": [0, 0, 0], "b": [1, 1, 1], "c": [2, 2, 2])"),
         "/objects/1: must have three corners that are not collinear, got [0, 0, 0], [1, 1, 1], "
         "[2, 2, 2]"},
        {object(
             "triangle",
             R"("a": [0, 0, 0], "b": [1, 0, 0], "c": [0, 1, 0], "normals": [[0, 0, 1], [0, 0, 0], [0, 0, 1]])"),
         "/objects/1/normals/1: must not be the zero vector, got [0, 0, 0]"},
        {object("box", R"("corner": [0, 0, 0], "edges": [[1, 0, 0], [0, 1, 0], [1, 1, 0]])"),
         "/objects/1/edges: must span a volume, got [1, 0, 0], [0, 1, 0], [1, 1, 0]"},
        {object("box", R"("corner": [0, 0, 0], "edges": [[1, 0, 0], [0, 0, 0], [1, 1, 0]])"),
         "/objects/1/edges/1: must not be the zero vector, got [0, 0, 0]"},
        {object("box", R"("min": [0, 0, 0], "max": [1, 0.0, 1])"),
         "/objects/1/max/1: must be more than min's 0, got 0.0"},
        {object("box", R"("min": [0, 0, 0], "max": [1, 1, 1e31])"),
         "/objects/1/max: must be a number from -1e30 to 1e30, got 1e+31"},
        {object("box", R"("min": [0, 0, 0], "corner": [1, 1, 1])"),
         R"(/objects/1: must not have both "corner" and "min")"},
        {object("box", R"("max": [0, 0, 0])"), R"(/objects/1: must have the key "min")"},
        {object("box", ""), R"(/objects/1: must have the key "corner")"},
        {object(
             "quadric",
             R"("matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 2, 0, -1]], "lower": [0, 0, 0], "upper": [1, 1, 1])"),
         "/objects/1/matrix/3/1: must be equal to matrix/1/3, because the matrix is symmetric, got "
         "2"},
        {object(
             "quadric",
             R"("matrix": [[1, 0, 0, 0], [0, 1, 0], [0, 0, 1, 0], [0, 0, 0, -1]], "lower": [0, 0, 0], "upper": [1, 1, 1])"),
         "/objects/1/matrix/1: must be an array of 4 numbers, got 3"},
        {object(
             "quadric",
             R"("matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -1]], "lower": [0, 0, 0], "upper": [1, 0, 1])"),
         "/objects/1/upper/1: must be more than lower's 0, got 0"},
        {object("sphereflake", R"("center": [0, 0, 0], "radius": 1, "depth": 1, "up": [0, 0, 0])"),
         "/objects/1/up: must not be the zero vector, got [0, 0, 0]"},
        {object("lattice", R"("n": 1, "spacing": 1, "sphere_radius": 1, "strut_radius": 1)"),
         R"(/objects/1: must have the key "corner")"},
        {object(
             "lattice",
             R"("corner": [0, 0, 0], "center": [0, 0, 0], "n": 1, "spacing": 1, "sphere_radius": 1, "strut_radius": 1)"),
         R"(/objects/1: must not have both "corner" and "center")"},
    });
}

TEST_CASE("a mistake in a material is not reported for its objects") {
    const std::string balls =
        R"("objects": [{"type": "sphere", "material": "red", "center": [0, 0, 0], "radius": 1},
                       {"type": "sphere", "material": "red", "center": [3, 0, 0], "radius": 1}])";
    const std::string complaint = R"(/materials/red: unknown key "colour", did you mean "color"?)";
    const std::string lights = R"("lights": [{"type": "point", "position": [30, 30, 30]}])";
    const std::string materials = R"("materials": {"red": {"colour": [1, 0, 0]}})";
    check({{"{" + camera + ", " + lights + ", " + materials + ", " + balls + "}", complaint},
           {"{" + camera + ", " + lights + ", " + balls + ", " + materials + "}", complaint}});
}

TEST_CASE("a light on a surface is reported with the index of the object that contains the shape") {
    const std::string ball =
        R"({"type": "sphere", "material": "clay", "center": [0, 0, 0], "radius": 1}, )";
    const std::string flake =
        R"({"type": "sphereflake", "material": "clay", "center": [60, 60, 60], "radius": 1, "depth": 2}, )";
    const std::string on_light =
        R"({"type": "sphere", "material": "clay", "center": [30, 31, 30], "radius": 1})";
    const std::string complaint =
        "/lights/0/position: must not be on a surface, got a point of /objects/";
    check({
        {with_objects(flake + ball + flake + ball + on_light), complaint + "4"},
        {with_objects(ball + on_light + ", " + flake + on_light), complaint + "1"},
        // The node at [29, 30, 30] has a radius that ends at the light.
        {with_objects(
             flake + ball +
             R"({"type": "lattice", "material": "clay", "corner": [28, 30, 30], "n": 2, "spacing": 1, "sphere_radius": 1, "strut_radius": 0.05})"),
         complaint + "2"},
        // The materials come last.
        {R"({"objects": [)" + flake + ball + on_light +
             R"(], "materials": {"clay": {}}, "lights": [{"type": "point", "position": [30, 30, 30]}], )" +
             camera + "}",
         complaint + "2"},
    });
}

TEST_CASE("invalid cameras and fogs and lights are reported") {
    check({
        {with_camera(R"("from": [0, 0, 1], "at": [0, 0, 0], "up": [0, 0, 2])"),
         "/camera/up: must not be along the line of sight, got [0, 0, 2]"},
        {with_camera(R"("from": [0, 0, 1], "at": [0, 0, 0], "up": [0, 0, 0])"),
         "/camera/up: must not be the zero vector, got [0, 0, 0]"},
        {with_camera(R"("from": [0, 0, 1], "at": [0, 0, 1])"),
         R"(/camera/at: must differ from "from", got [0, 0, 1])"},
        {with_camera(R"("from": [0, 0, 1], "at": [0, 0, 0], "field_of_view": 0)"),
         "/camera/field_of_view: must be between 0 and 180 degrees, both excluded, got 0"},
        {with_camera(R"("from": [0, 0, 1], "at": [0, 0, 0], "field_of_view": 180)"),
         "/camera/field_of_view: must be between 0 and 180 degrees, both excluded, got 180"},
        {with_camera(R"("type": "orthographic", "from": [0, 0, 1], "at": [0, 0, 0], "height": 0)"),
         "/camera/height: must be positive, got 0"},
        {with(R"("fog": {"type": "linear-z", "start": 1, "end": 1})"),
         "/fog/end: must differ from start, got 1"},
        {with(R"("fog": {"type": "linear", "start": 2, "end": 1})"),
         "/fog/end: must be more than start's 2, got 1"},
        {with(R"("fog": {"type": "exponential", "density": 0})"),
         "/fog/density: must be positive, got 0"},
        {with(R"("lights": [{"type": "directional", "direction": [0, 0, 0]}])"),
         "/lights/0/direction: must not be the zero vector, got [0, 0, 0]"},
        {with(R"("lights": [{"type": "sphere", "position": [0, 0, 0], "radius": 0}])"),
         "/lights/0/radius: must be positive, got 0"},
        {with(R"("lights": [{"type": "sky", "reach": 0}])"),
         "/lights/0/reach: must be positive, got 0"},
        {with(R"("lights": [{"type": "sky", "ground": [0, 0, -1]}])"),
         "/lights/0/ground/2: must not be negative, got -1"},
        {with(R"("lights": [{"type": "sky", "position": [0, 0, 0]}])"),
         R"(/lights/0: unknown key "position", must be "type", "direction", "color", "ground" or "reach")"},
        {with(
             R"("lights": [{"type": "rectangle", "position": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [1, 1, 0]}])"),
         "/lights/0/edge_v: must be perpendicular to edge_u's [1, 0, 0], got [1, 1, 0]"},
        {with_camera(R"("from": [0, 0, 1], "at": [0, 0, 0], "lens_radius": -1)"),
         "/camera/lens_radius: must not be negative, got -1"},
        {with(R"("sampling": {"light_samples": -2})"),
         "/sampling/light_samples: must be from -1 to 4096, got -2"},
        {with(
             R"("lights": [{"type": "point", "position": [0, 0, 0]}, {"type": "point", "position": [0, 0, 0], "color": [0, -1, 0]}])"),
         "/lights/1/color/1: must not be negative, got -1"},
        {with_objects(
             R"({"type": "sphere", "material": "clay", "center": [30, 30, 31], "radius": 1})"),
         "/lights/0/position: must not be on a surface, got a point of /objects/0"},
        {"{" + camera +
             R"(, "objects": [{"type": "sphere", "material": {}, "center": [0, 0, 0], "radius": 1}]})",
         "/lights: must have at least one light if there are objects, or be [] for no lights, got "
         "none"},
    });
}

TEST_CASE("an empty list of lights adds no light") {
    const auto lights = [](const std::string& text) {
        return scene_of(
                   "{" + text +
                   R"(, "objects": [{"type": "sphere", "material": {}, "center": [0, 0, 0], "radius": 1}]})")
            .lights()
            .size();
    };
    CHECK(lights(camera + R"(, "lights": [])") == 0);
    CHECK(lights(R"("camera": "auto")") > 0);
    CHECK(lights(R"("camera": "auto", "lights": [])") == 0);
}
