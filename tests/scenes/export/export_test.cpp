#include "scenes/export/export.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/places.hpp"
#include "tests/scenes/export/exports.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

using namespace raylane;
using namespace raylane::scenes;
using tests::complaint;
using tests::image_of;

namespace {

std::filesystem::path shipped(const std::string& name) {
    return std::filesystem::path(RAYLANE_SOURCE_DIR) / "scenes" / (name + ".json");
}

std::vector<std::filesystem::path> all_shipped() {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(RAYLANE_SOURCE_DIR) / "scenes"))
        if (entry.path().extension() == ".json" && entry.path().stem().extension() != ".schema")
            paths.push_back(entry.path());
    REQUIRE(paths.size() >= 14);
    return paths;
}

/// Returns kind and numbers of all shapes as floats, by id.
std::vector<float> floats_in(const core::Scene& scene) {
    std::vector<float> values;
    for_each_by_id(scene, [&](const auto& shape, core::ShapeId) {
        const auto floats = core::numbers_of(shape);
        values.push_back(static_cast<float>(core::kind_of<std::decay_t<decltype(shape)>>));
        values.insert(values.end(), floats.begin(), floats.end());
    });
    return values;
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

TEST_CASE("a scene survives a JSON export unchanged") {
    const tests::TemporaryDirectory directory;
    for (const std::filesystem::path& path : all_shipped()) {
        CAPTURE(path.filename());
        const core::Scene scene = load_scene(path);
        const std::filesystem::path copy = directory.path() / "copy.json";
        CHECK(export_scene(copy, scene).empty());
        const core::Scene again = load_scene(copy);
        CHECK(floats_in(again) == floats_in(scene));
        CHECK(again.settings().width == scene.settings().width);
        CHECK(again.settings().grid == scene.settings().grid);
        CHECK(again.settings().samples == scene.settings().samples);
        CHECK(again.settings().quality == scene.settings().quality);
        CHECK(again.settings().filter == scene.settings().filter);
        CHECK(again.settings().max_depth == scene.settings().max_depth);
        CHECK(again.settings().min_weight == scene.settings().min_weight);
        CHECK(image_of(again) == image_of(scene));
    }
}

TEST_CASE("zeros keep their signs in JSON") {
    const tests::TemporaryDirectory directory;
    const core::Scene scene = tests::scene_of(R"({"camera": {"from": [-0.0, 2, 9], "at": [0, 1, 0]},
        "lights": [{"type": "directional", "direction": [-0.0, -1, 0.0]}], "materials": {"m": {}},
        "objects": [{"type": "sphere", "material": "m", "center": [-0.0, 0, -0.0], "radius": 1}]})");
    export_scene(directory.path() / "copy.json", scene);
    const core::Scene again = load_scene(directory.path() / "copy.json");
    const auto signs = [](const auto& v) {
        return std::array{std::signbit(v.x), std::signbit(v.y), std::signbit(v.z)};
    };
    CHECK(signs(again.camera().from) == std::array{true, false, false});
    CHECK(signs(again.lights()[0].direction) == std::array{true, true, false});
    const auto& spheres = std::get<core::Table<core::Sphere>>(again.shapes());
    CHECK(signs(spheres.get({0, 0}).center) == std::array{true, false, true});
}

TEST_CASE("JSON export writes every value of a scene") {
    const tests::TemporaryDirectory directory;
    const core::Scene scene = tests::scene_of(R"({
        "camera": {"type": "orthographic", "from": [0.1, 2, 9], "at": [0, 1, 0], "up": [0, 1, 0.2],
                   "height": 3.3, "lens_radius": 0.25, "focus_distance": 7.5},
        "image": {"width": 30, "height": 20, "transfer": "linear", "alpha": true},
        "sampling": {"grid": 3, "pattern": "stratified", "quality": 41, "filter": "blackman-harris",
                     "light_samples": 3},
        "limits": {"max_depth": 3, "min_weight": 0.03, "max_transparent": 7},
        "outline": {"width": 1.5, "color": [0.1, 0.2, 0.3], "creases": 30},
        "background": [0.1, 0.2, 0.3],
        "fog": {"type": "exponential", "density": 0.05, "color": [1, 0, 0.5]},
        "lights": [{"type": "directional", "direction": [1, -2, 0.1], "color": [2, 1, 1]},
                   {"type": "point", "position": [3, 4, 5]},
                   {"type": "sky", "direction": [0, -1, -1], "color": [1, 2, 3],
                    "ground": [0.1, 0.2, 0.3], "reach": 8.5},
                   {"type": "sphere", "position": [3, 4, 5], "radius": 0.75},
                   {"type": "disc", "position": [3, 4, 6], "direction": [0, 0, -1], "radius": 1.25},
                   {"type": "rectangle", "position": [3, 4, 7], "edge_u": [1, 0, 0],
                    "edge_v": [0, 2.5, 0]}],
        "materials": {
            "s": {"pattern": {"type": "stripes", "colors": [[1, 0, 0], [0, 1, 0]], "width": 0.3,
                              "direction": [1, 2, 3]}, "visible": "inside"},
            "c": {"pattern": {"type": "checker", "colors": [[1, 0, 0], [0, 1, 0]], "size": 0.7,
                              "axes": "yz", "upper_edges": "z"}, "visible": "outside"},
            "g": {"pattern": {"type": "gradient", "colors": [[1, 0, 0], [0, 1, 0]],
                              "from": [0, 1, 0], "to": [1, 1, 1]}, "reflection": "schlick"},
            "f": {"pattern": {"type": "formula", "color": ["x < 0.1 ? \u0079 : 1", "u\n+ v", "2e-1"]}},
            "w": {"ambient": 0.3, "diffuse": 0.4, "specular": 0.5, "exponent": 7,
                  "highlight": "phong",
                  "reflection": "dielectric", "transmission": 0.9, "index": 1.7, "opacity": 0.6,
                  "absorption": [0.1, 0.2, 0.3]}},
        "objects": [
            {"type": "triangle", "material": "s", "a": [0, 0, 0], "b": [1, 0, 0], "c": [0, 1, 0],
             "normals": [[0, 0, 1], [0, 0.1, 1], [0.1, 0, 1]]},
            {"type": "triangle", "material": "c", "a": [0, 0, 1], "b": [1, 0, 1], "c": [0, 1, 1]},
            {"type": "disc", "material": "g", "center": [1, 1, 1], "normal": [0, 1, 1],
             "radius": 0.5},
            {"type": "cylinder", "material": "w", "base": [0, 0, 2], "axis": [0, 1, 0],
             "radius": 0.3, "capped": false},
            {"type": "cone", "material": "w", "base": [0, 0, 3], "axis": [0, 1, 0],
             "base_radius": 0.3, "top_radius": 0.1, "capped": false}]
    })");
    const std::filesystem::path copy = directory.path() / "copy.json";
    CHECK(export_scene(copy, scene).empty());
    const core::Scene again = load_scene(copy);
    CHECK(floats_in(again) == floats_in(scene));
    CHECK(image_of(again) == image_of(scene));
    // A second export would show a value that was lost in the first.
    const std::filesystem::path twice = directory.path() / "twice.json";
    export_scene(twice, again);
    CHECK(text_of(twice) == text_of(copy));
    for (const char* part : {R"("transfer": "linear", "alpha": true)",
                             R"("pattern": "stratified")",
                             R"("height": 3.3)",
                             R"("lens_radius": 0.25)",
                             R"("focus_distance": 7.5)",
                             R"("light_samples": 3)",
                             R"("reach": 8.5)",
                             R"("radius": 0.75)",
                             R"("radius": 1.25)",
                             R"("ground": [0.1, 0.2, 0.3])",
                             R"("edge_v": [0, 2.5, 0])",
                             R"("axes": "yz")",
                             R"("color": ["x < 0.1 ? y : 1","u\n+ v","2e-1"])",
                             R"("highlight": "phong")",
                             R"("visible": "inside")",
                             R"("visible": "outside")",
                             R"("reflection": "schlick")",
                             R"("reflection": "dielectric")",
                             R"("density": 0.05)",
                             R"("absorption": [0.1, 0.2, 0.3])",
                             R"("opacity": 0.6)",
                             R"("max_transparent": 7)",
                             R"("direction": [1, -2, 0.1])"}) {
        CAPTURE(part);
        CHECK(text_of(copy).find(part) != std::string::npos);
    }
}

TEST_CASE("NFF export keeps the supported shapes and reports the omitted features") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "scene.nff";
    const core::Scene scene = load_scene(shipped("lattice"));
    const std::vector<std::string> left_out = export_scene(path, scene);
    for (const char* what : {"ambient coefficients", "planes beyond a finite square"}) {
        CAPTURE(what);
        CHECK(std::find(left_out.begin(), left_out.end(), what) != left_out.end());
    }
    const core::Scene again = load_scene(path);
    CHECK(again.shape_count() == scene.shape_count() + 1); // the floor is two triangles
    CHECK(std::get<core::Table<core::Sphere>>(again.shapes()).size() ==
          std::get<core::Table<core::Sphere>>(scene.shapes()).size());
    CHECK(again.camera().field_of_view == Approx(scene.camera().field_of_view).epsilon(1e-6));
    CHECK(again.lights().size() == scene.lights().size());
    CHECK(again.settings().width == scene.settings().width);

    // Six faces whose fronts point outwards, so that the box is lit from outside.
    const core::Scene box = tests::scene_of(tests::with_objects(
        R"({"type": "box", "material": "clay", "corner": [1, 2, 3],
            "edges": [[0, 1, 0], [1, 0, 0], [0, 0, 1]]})"));
    export_scene(path, box);
    const core::Scene faces = load_scene(path);
    REQUIRE(faces.shape_count() == 12);
    for_each_by_id(faces, [](const auto& shape, core::ShapeId) {
        if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, core::Triangle>) {
            const core::Vec3f normal = core::cross(shape.b - shape.a, shape.c - shape.a);
            CHECK(core::dot(normal, shape.a - core::Vec3f(1.5F, 2.5F, 3.5F)) > 0.0F);
        }
    });

    CHECK(complaint(path, load_scene(shipped("quadric"))) ==
          path.string() + ": cannot store a quadric: use .pov or .json");
    CHECK(load_scene(path).shape_count() == 12); // the old file stays
}

TEST_CASE("Materials keep their names from JSON to JSON") {
    const std::string text = R"({"camera": "auto", "lights": [],
        "materials": {"clay": {"color": [1, 0, 0]}, "1": {}, "\"caf\u00e9\" \\": {}, "0": {}},
        "definitions": {"ball": {"type": "sphere", "center": [0, 0, 0], "radius": 1},
                        "red": {"type": "group", "material": "clay",
                                "objects": [{"type": "instance", "of": "ball"}]}},
        "objects": [{"type": "instance", "of": "red"},
                    {"type": "instance", "of": "ball", "material": "\"caf\u00e9\" \\"},
                    {"type": "sphere", "material": {}, "center": [2, 0, 0], "radius": 1},
                    {"type": "sphere", "material": "late", "center": [4, 0, 0], "radius": 1},
                    {"type": "difference", "material": "clay", "objects": [
                      {"type": "sphere", "center": [6, 0, 0], "radius": 1},
                      {"type": "sphere", "material": "0", "center": [6, 0, 1], "radius": 1}]}]})";
    std::string late = text; // names come before their materials
    const std::string materials = late.substr(
        late.find("\"materials\""), late.find("\"definitions\"") - late.find("\"materials\""));
    late.erase(late.find(materials), materials.size());
    late.insert(late.rfind('}'),
                ", " + materials.substr(0, materials.rfind('}')) + ", \"late\": {}}");
    const auto names = [](const core::Scene& scene) {
        std::vector<std::string> found;
        for (core::ShapeId id = 0; id < scene.shape_count(); ++id)
            found.emplace_back(scene.material_name(scene.material_index_of(id)));
        return found;
    };
    const std::vector<std::string> expected = {"clay", "\"caf\xC3\xA9\" \\", "", "late", "clay",
                                               "0"};
    const tests::TemporaryDirectory directory;
    core::Scene scene = tests::scene_of(late);
    REQUIRE(names(scene) == expected);
    for (int i = 0; i < 2; ++i) {
        scenes::export_scene(directory.path() / "a.json", scene);
        scene = scenes::load_scene(directory.path() / "a.json");
        CHECK(names(scene) == expected);
        CHECK(scene.materials().size() == 6);
    }
    const nlohmann::json written =
        nlohmann::json::parse(tests::content_of(directory.path() / "a.json"));
    CHECK(written["objects"][0]["material"] == "clay");
    CHECK(written["objects"][2]["material"] == "5");
}

TEST_CASE("Materials with equal names or without names differ in JSON") {
    core::SceneBuilder builder;
    builder.auto_camera.fit_camera.emplace();
    builder.wants_light = false;
    for (const char* name : {"", "red", "red", "0", "red-2", "\xFF", "\xFE"}) {
        const core::MaterialIndex material = builder.add_material({});
        builder.name_material(material, name);
        if (*name != '\0') builder.name_material(material, "second");
        builder.add(core::Sphere{{static_cast<float>(3 * material), 0, 0}, 1}, material);
    }
    const tests::TemporaryDirectory directory;
    scenes::export_scene(directory.path() / "a.json", std::move(builder).build());
    const nlohmann::json written =
        nlohmann::json::parse(tests::content_of(directory.path() / "a.json"));
    std::vector<std::string> names;
    for (const nlohmann::json& object : written["objects"])
        names.push_back(object["material"]);
    CHECK(names ==
          std::vector<std::string>{"0-2", "red", "red-2", "0", "red-2-2", "\uFFFD", "\uFFFD-2"});
    CHECK(written["materials"].size() == names.size());
}

TEST_CASE("Materials keep the names that are valid in POV-Ray's language") {
    const auto written = [](const std::vector<const char*>& names) {
        core::SceneBuilder builder;
        builder.auto_camera.fit_camera.emplace();
        builder.wants_light = false;
        for (const char* name : names) {
            core::Material expected;
            expected.ambient = 0.01F * static_cast<float>(builder.shape_count()); // all differ
            const core::MaterialIndex material = builder.add_material(expected);
            builder.name_material(material, name);
            builder.add(core::Sphere{{static_cast<float>(3 * material), 0, 0}, 1}, material);
        }
        const tests::TemporaryDirectory directory;
        const std::filesystem::path path = directory.path() / "a.pov";
        scenes::export_scene(path, std::move(builder).build());
        const core::Scene scene = scenes::load_scene(path);
        std::vector<std::string> found;
        for (core::ShapeId id = 0; id < scene.shape_count(); ++id)
            found.emplace_back(scene.material_name(scene.material_index_of(id)));
        return found;
    };
    const std::vector<std::string> names = {"m_red", "Clay", "m_red_2", "m3",      "m4", "m5", "m1",
                                            "m_m_2", "m_x",  "Clay_2",  "m_mesh2", "m11"};
    CHECK(written({"red", "Clay", "red", "", "caf\xC3\xA9", "2b", "m1", "m_m_2", "x", "Clay",
                   "mesh2", "a name of several words"}) == names);
    CHECK(written({"m_red", "Clay", "m_red_2"}) ==
          std::vector<std::string>{"m_red", "Clay", "m_red_2"});
}

TEST_CASE("POV-Ray export writes every shape and reports the approximated features") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "scene.pov";
    CHECK(export_scene(path, load_scene(shipped("birthday"))) ==
          std::vector<std::string>{"Schlick reflection (written as Fresnel)",
                                   "ambient and diffuse light of fully transmissive materials",
                                   "formula patterns", "linear fog"});
    const std::string text = text_of(path);
    const auto count = [&](const std::string& part) {
        int times = 0;
        for (std::size_t at = text.find(part); at != std::string::npos;
             at = text.find(part, at + 1))
            ++times;
        return times;
    };
    CHECK(count("\nsphere {") == 5);
    CHECK(count("\nplane {") == 2);
    CHECK(count("\nbox {") == 1);
    CHECK(count("\ncylinder {") == 2);
    CHECK(count("\ncone {") == 1);
    CHECK(count("\nquadric {") == 2);
    CHECK(count("camera {") == 1);
    CHECK(count("light_source {") == 1);
    CHECK(count("{") == count("}"));
}

TEST_CASE("an outline of width 0 keeps its colour in JSON and NFF export reports a missing light") {
    const tests::TemporaryDirectory directory;
    core::SceneBuilder builder;
    builder.wants_light = false;
    builder.settings.outline = {0.0F, core::Color(0.25F, 0.5F, 1.0F), 30.0F};
    builder.add(core::Sphere{{0, 0, 0}, 1}, builder.add_material({}));
    const core::Scene scene = std::move(builder).build();
    export_scene(directory.path() / "a.json", scene);
    const core::Outline again = load_scene(directory.path() / "a.json").settings().outline;
    CHECK(again.width == 0.0F);
    CHECK(again.color == core::Color(0.25F, 0.5F, 1.0F));
    CHECK(again.creases == 30.0F);
    const auto told = export_scene(directory.path() / "a.nff", scene);
    CHECK(std::find(told.begin(), told.end(),
                    "a scene without lights (raylane does not read the file)") != told.end());
}

TEST_CASE("POV-Ray export lights glass as raylane does or reports the difference") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "scene.pov";
    const auto told = [&](core::Material material, const auto& shape) {
        core::SceneBuilder builder;
        builder.wants_light = false;
        builder.add(shape, builder.add_material(material));
        return export_scene(path, std::move(builder).build());
    };
    core::Material glass;
    glass.ambient = 0.125F;
    glass.diffuse = 0.25F;
    glass.transmission = 0.75F;
    const core::Sphere ball{{0, 0, 0}, 1};
    CHECK(told(glass, ball).empty());
    CHECK(text_of(path).find("ambient 0.5 diffuse 1") != std::string::npos);

    const auto has = [](const std::vector<std::string>& words, const std::string& start) {
        return std::any_of(words.begin(), words.end(),
                           [&](const std::string& word) { return word.starts_with(start); });
    };
    // Half of a lens.
    const core::Quadric bowl{{0, 0, 0}, 1, 1, 1, 0, 0, 0, 0, 0, 0, -1, {-1, -1, 0}, {1, 1, 1}};
    CHECK(has(told(glass, bowl), "bodies enclosed by several transmissive surfaces"));
    glass.transmission = 1.0F;
    CHECK(has(told(glass, ball), "ambient and diffuse light of fully transmissive materials"));
    glass.ambient = glass.diffuse = 0.0F;
    CHECK(told(glass, ball).empty());
    glass.transmission = 0.0F;
    CHECK(told(glass, bowl).empty());

    // POV-Ray's transmit weighs the pigment but not the highlight.
    core::Material film;
    film.specular = 0.5F;
    film.opacity = 0.25F;
    CHECK(told(film, bowl).empty());
    for (const char* part :
         {"transmit 0.75", "diffuse 0.8 specular 0.125", "max_trace_level 256"}) {
        CAPTURE(part);
        CHECK(text_of(path).find(part) != std::string::npos);
    }
    CHECK(text_of(path).find("ior") == std::string::npos); // an ior would make it a body
    film.transmission = 0.5F;
    CHECK(has(told(film, ball), "opacity of transmissive materials"));
}

TEST_CASE("POV-Ray export warns if the camera gets into a medium that raylane does not have") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "scene.pov";
    const auto is_misled = [&](const auto& shape, const core::Material& material) {
        core::SceneBuilder builder;
        builder.wants_light = false;
        builder.camera.from = {0, 0, 5};
        builder.add(shape, builder.add_material(material));
        const auto told = export_scene(path, std::move(builder).build());
        return std::any_of(told.begin(), told.end(), [](const std::string& words) {
            return words.starts_with("opaque bodies with Fresnel reflection around the camera");
        });
    };
    const auto has_index = [&] { return text_of(path).find("ior") != std::string::npos; };
    const core::Sphere sky{{0, 0, 0}, 50}, ball{{0, 0, 0}, 1};
    const core::Plane floor{{0, -1, 0}, {0, 1, 0}}, ceiling{{0, 1, 0}, {0, 1, 0}};
    core::Material material;
    CHECK(!is_misled(sky, material));
    CHECK(!has_index());
    material.reflectivity = 0.5F;
    CHECK(!is_misled(sky, material));
    CHECK(!has_index());
    material.reflection = core::Reflection::dielectric;
    CHECK(is_misled(sky, material));
    CHECK(is_misled(ceiling, material));
    CHECK(!is_misled(ball, material));
    CHECK(has_index()); // its reflection needs the index
    CHECK(!is_misled(floor, material));
    material.transmission = 1.0F;
    CHECK(!is_misled(sky, material)); // the camera is in the medium in raylane, too
    CHECK(has_index());
}

TEST_CASE("export refuses an unknown ending") {
    CHECK(complaint("scene.obj", tests::scene_of(tests::with_objects(""))) ==
          "scene.obj: must end in .json, .nff, .pov or .rl");
}

TEST_CASE("endings of scene files may have upper and lower case letters") {
    const tests::TemporaryDirectory directory;
    const core::Scene scene = load_scene(shipped("sphere"));
    for (const char* name : {"a.JSON", "a.Rl", "a.Pov"}) {
        CAPTURE(name);
        export_scene(directory.path() / name, scene);
        CHECK(load_scene(directory.path() / name).shape_count() == scene.shape_count());
    }
}

TEST_CASE("export reports formats that lose polygons made of triangles") {
    const tests::TemporaryDirectory directory;
    core::SceneBuilder builder;
    const std::array<core::Triangle, 2> halves = {
        {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};
    builder.add_polygon(std::span<const core::Triangle>(halves), builder.add_material({}));
    builder.add_light({.position = {0, 0, 9}});
    const core::Scene scene = std::move(builder).build();
    for (const char* name : {"a.json", "a.nff", "a.pov", "a.rl"}) {
        CAPTURE(name);
        const std::vector<std::string> told = export_scene(directory.path() / name, scene);
        const bool is_told = std::ranges::find(told, "polygons made of triangles") != told.end();
        CHECK(is_told == (std::string(name) != "a.rl"));
        CHECK(load_scene(directory.path() / name).polygons().empty() == is_told);
    }
}

TEST_CASE("NFF export reports that no light is left if NFF supports none of them") {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "a.nff";
    for (const core::LightKind kind : {core::LightKind::sky, core::LightKind::directional,
                                       core::LightKind::sphere, core::LightKind::point}) {
        core::SceneBuilder builder;
        builder.add(core::Sphere{{0, 0, 0}, 1}, builder.add_material({}));
        builder.add_light({.kind = kind, .position = {0, 0, 9}});
        const auto told = export_scene(path, std::move(builder).build());
        const bool is_told =
            std::ranges::find(told, "a scene without lights (raylane does not read the file)") !=
            told.end();
        CHECK(is_told == (kind != core::LightKind::point));
        if (is_told)
            CHECK_THROWS_AS(load_scene(path), BadInput);
        else
            CHECK(load_scene(path).lights().size() == 1);
    }
}
