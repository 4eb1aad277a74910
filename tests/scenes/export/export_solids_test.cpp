#include "scenes/export/export.hpp"
#include "scenes/formats/scene_file.hpp"
#include "tests/scenes/export/exports.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

using namespace raylane;
using namespace raylane::scenes;
using tests::complaint;
using tests::image_of;

TEST_CASE("export accepts solids exactly as deep as the readers do") {
    const tests::TemporaryDirectory directory;
    const auto nested = [](const core::Solid& innermost, int depth) {
        core::Solid solid = innermost;
        for (int i = 1; i < depth; ++i) {
            constexpr core::Made ways[] = {core::Made::by_union, core::Made::by_difference,
                                           core::Made::by_intersection};
            core::Solid other;
            other.shape = core::SphereOf<double>{{0.01 * i, 0, 0.5}, i % 3 == 2 ? 9.0 : 0.75};
            core::Solid outer{ways[i % 3]};
            outer.parts = {std::move(solid), other};
            solid = std::move(outer);
        }
        core::SceneBuilder builder;
        builder.camera.from = {0, 0, 30};
        builder.add_light({.position = {0, 0, 29}});
        builder.add_solid(solid, builder.add_material({}));
        return std::move(builder).build();
    };
    core::Solid ball, box;
    ball.shape = core::SphereOf<double>{{0, 0, 0}, 1};
    box.shape = core::BoxOf<double>{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    struct Row {
        const core::Solid& innermost;
        const char* name;
        int deepest;
        const char* refusal;
    };
    for (const Row& row :
         {Row{ball, "a.json", 128,
              "must not have a solid of more than 256 levels of objects and lists, got 258"},
          Row{box, "a.json", 127,
              "must not have a solid of more than 256 levels of objects and lists, got 257"},
          Row{ball, "a.pov", 125, "must not have solids nested more than 125 deep, got 126"},
          Row{box, "a.pov", 125, "must not have solids nested more than 125 deep, got 126"}}) {
        const std::filesystem::path path = directory.path() / row.name;
        CAPTURE(path, row.deepest);
        const core::Scene scene = nested(row.innermost, row.deepest);
        CHECK(complaint(path, scene).empty());
        CHECK(load_scene(path).shape_count() == scene.shape_count());
        std::filesystem::remove(path);
        CHECK(complaint(path, nested(row.innermost, row.deepest + 1)) ==
              path.string() + ": " + row.refusal);
        CHECK_FALSE(std::filesystem::exists(path));
    }
}

namespace {

const std::string solids = R"({"camera": {"from": [4, 5, 6], "at": [0, 0, 0]},
    "lights": [{"type": "point", "position": [30, 40, 50]}],
    "materials": {"clay": {}, "glass": {"transmission": 1}, "red": {"color": [1, 0, 0]}},
    "objects": [)" + tests::three_solids +
                           "]}";

} // namespace

TEST_CASE("an exported solid reads back with the same nodes and image") {
    const tests::TemporaryDirectory directory;
    const core::Scene scene = tests::scene_of(solids);
    const std::filesystem::path path = directory.path() / "solids.json";
    export_scene(path, scene);
    const core::Scene again = load_scene(path);
    CHECK(again.solids().nodes().size() == scene.solids().nodes().size());
    CHECK(image_of(again) == image_of(scene));
    const std::string once = tests::content_of(path);
    export_scene(path, again);
    CHECK(tests::content_of(path) == once);

    const std::filesystem::path pov = directory.path() / "solids.pov";
    export_scene(pov, scene);
    const std::string text = tests::content_of(pov);
    for (const char* word :
         {"difference { intersection { box {", "merge { cone {", "clipped_by { difference { box {",
          "difference { cylinder {", "intersection { quadric {"}) {
        INFO(word << " in " << text);
        CHECK(text.find(word) != std::string::npos);
    }
    CHECK(complaint(directory.path() / "solids.nff", scene)
              .find("cannot store constructed solids: use .pov or .json") != std::string::npos);
}

namespace {

/// Returns the warnings of an export to POV-Ray, one a line, and the file's content.
std::pair<std::string, std::string> for_povray(const std::string& materials,
                                               const std::string& objects) {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "a.pov";
    std::string told;
    for (const std::string& words :
         export_scene(path, tests::scene_of(R"({"camera": {"from": [0.5, 0, 0], "at": [2, 0, 0]},
             "lights": [{"type": "point", "position": [30, 40, 50]}],
             "materials": {)" + materials + R"(}, "objects": [)" +
                                            objects + "]}")))
        told += words + "\n";
    return {told, tests::content_of(path)};
}
const std::string two_balls = R"("objects": [
    {"type": "sphere", "center": [0, 0, 0], "radius": 1},
    {"type": "sphere", "center": [1, 0, 0], "radius": 1}]})",
                  painted_balls = R"("material": "clay", "objects": [
    {"type": "sphere", "center": [0, 0, 0], "radius": 1},
    {"type": "sphere", "center": [1, 0, 0], "radius": 1, "material": "m"}]})";

} // namespace

TEST_CASE("transparent unions are merges without inner walls in POV-Ray") {
    for (const std::string& objects : {R"({"type": "union", "material": "m", )" + two_balls,
                                       R"({"type": "union", )" + painted_balls}) {
        CAPTURE(objects);
        const auto text_with = [&](const std::string& material) {
            return for_povray(R"("clay": {}, "m": )" + material, objects).second;
        };
        CHECK(text_with("{}").find("union {") != std::string::npos);
        for (const char* material : {R"({"opacity": 0.4})", R"({"transmission": 0.5})"}) {
            CHECK(text_with(material).find("merge {") != std::string::npos);
            CHECK(text_with(material).find("union {") == std::string::npos);
        }
    }
}

TEST_CASE("faces of cuts have the textures of the parts in POV-Ray") {
    const std::string text =
        for_povray(R"("clay": {}, "m": {}, "face": {"pattern": {"type": "cutaway"}})",
                   R"({"type": "intersection", "material": "face", "objects": [
                       {"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"},
                       {"type": "plane", "point": [0, 0, 0.5], "normal": [0, 0, 1],
                        "material": "face"}]})")
            .second;
    CHECK(text.find(" cutaway_textures }") != std::string::npos);
}

TEST_CASE("fog fills panes and no glass for POV-Ray") {
    const auto fills = [](const std::string& material, const std::string& objects) {
        return for_povray(R"("clay": {}, "m": )" + material +
                              R"(}, "fog": {"type": "exponential", "density": 0.05)",
                          objects)
                   .second.find("hollow") != std::string::npos;
    };
    for (const std::string& objects :
         {R"({"type": "union", "material": "m", )" + two_balls,
          R"({"type": "union", )" + painted_balls,
          std::string(
              R"({"type": "sphere", "center": [9, 0, 0], "radius": 1, "material": "m"})")}) {
        CAPTURE(objects);
        CHECK(fills(R"({"opacity": 0.4})", objects));
        CHECK(!fills(R"({"transmission": 0.5})", objects));
        CHECK(!fills("{}", objects));
    }
    CHECK(
        for_povray(R"("m": {"opacity": 0.4})", R"({"type": "union", "material": "m", )" + two_balls)
            .second.find("hollow") == std::string::npos);
}

TEST_CASE(
    "POV-Ray export warns of surfaces shared by lenses and of opaque solids around the camera") {
    const auto lenses = [](const std::string& material, const std::string& first,
                           const std::string& second) {
        const std::string start =
            R"({"type": "lens", "axis": [1, 0, 0], "radius": 2, "material": "m", )";
        return for_povray(R"("m": )" + material, start + first + "}, " + start + second + "}")
                   .first.find("surfaces shared by two transmissive bodies") != std::string::npos;
    };
    const std::string glass = R"({"transmission": 1})",
                      crown = R"("vertex": [9, 0, 0], "radii": [4, -3], "thickness": 1.5)",
                      flint = R"("vertex": [10.5, 0, 0], "radii": [-3, -9], "thickness": 0.5)";
    CHECK(lenses(glass, crown, flint));
    CHECK(!lenses("{}", crown, flint));
    CHECK(
        !lenses(glass, crown, R"("vertex": [10.5, 0, 0], "radii": [-2.5, -9], "thickness": 0.5)"));
    CHECK(
        !lenses(glass, crown, R"("vertex": [10.625, 0, 0], "radii": [-3, -9], "thickness": 0.5)"));
    // A flat surface and a conic one, each shared by two lenses.
    CHECK(lenses(glass, R"("vertex": [9, 0, 0], "radii": [4, 0], "thickness": 1.5)",
                 R"("vertex": [10.5, 0, 0], "radii": [0, -9], "thickness": 0.5)"));
    CHECK(lenses(glass, crown + R"(, "conics": [0, -0.5])", flint + R"(, "conics": [-0.5, 0])"));

    const auto is_misled = [](const std::string& object) {
        return for_povray(R"("m": {"reflection": "dielectric"})", object)
                   .first.find("opaque bodies with Fresnel") != std::string::npos;
    };
    CHECK(is_misled(R"({"type": "union", "material": "m", )" + two_balls));
    CHECK(is_misled(R"({"type": "intersection", "material": "m", )" + two_balls));
    CHECK(!is_misled(R"({"type": "difference", "material": "m", )" + two_balls));
}

namespace {

/// Returns the kind and material of each shape, by id. They identify the parts.
std::vector<std::pair<core::Kind, core::MaterialIndex>> parts_of(const core::Scene& scene) {
    std::vector<std::pair<core::Kind, core::MaterialIndex>> parts;
    for (core::ShapeId id = 0; id < scene.shape_count(); ++id)
        parts.emplace_back(scene.solids().node(scene.solids().part_of(id)).kind,
                           scene.material_index_of(id));
    return parts;
}

} // namespace

TEST_CASE("export keeps the order of a solid's parts and clips by any form of solid") {
    const std::string ball = R"({"type": "sphere", "center": [0, 0, 1], "radius": 1})",
                      plane = R"({"type": "plane", "point": [0, 0, 0], "normal": [1, 0, 0]})",
                      box = R"({"type": "box", "min": [-1, -1, -1], "max": [1, 1, 1]})";
    const auto solid_text = [](const std::string& type, const std::vector<std::string>& objects) {
        std::string list;
        for (const std::string& object : objects)
            list += (list.empty() ? "" : ", ") + object;
        return R"({"type": ")" + type + R"(", "objects": [)" + list + "]}";
    };
    const auto red = [](std::string object) { return object.insert(1, R"("material": "red", )"); };
    const tests::TemporaryDirectory directory;
    for (const std::string& object : {
             solid_text("clip", {ball, solid_text("union", {box, plane})}),
             solid_text("clip",
                        {box, solid_text("union", {solid_text("clip", {ball, plane}), plane})}),
             solid_text("clip",
                        {box, solid_text("union", {solid_text("difference", {ball, plane}), box})}),
             solid_text("clip", {box, solid_text("intersection",
                                                 {solid_text("union", {ball, box}), plane})}),
             solid_text("clip",
                        {box, solid_text("difference", {box, solid_text("union", {ball, plane})})}),
             solid_text("difference",
                        {box, solid_text("clip", {ball, solid_text("union", {plane, box})})}),
             solid_text("intersection", {solid_text("difference", {box, red(ball)}), box}),
             solid_text("intersection", {solid_text("difference", {box, ball, red(box)}), ball,
                                         solid_text("difference", {red(box), plane, ball})}),
             solid_text("difference", {box, solid_text("difference", {ball, red(box)}), ball}),
             solid_text("difference",
                        {box, solid_text("intersection",
                                         {solid_text("difference", {ball, box}), red(ball)})}),
             solid_text("union", {solid_text("intersection",
                                             {solid_text("difference", {box, ball}), red(box)}),
                                  ball}),
             solid_text("union", {ball}),
             solid_text("union", {red(box)}),
             solid_text("intersection", {plane}),
         }) {
        CAPTURE(object);
        std::string with_material = object;
        with_material.insert(1, R"("material": "clay", )");
        const core::Scene scene = tests::scene_of(
            R"({"camera": {"from": [4, 5, 6], "at": [0, 0, 0]},
                "lights": [{"type": "point", "position": [30, 40, 50]}],
                "materials": {"clay": {}, "red": {"color": [1, 0, 0]}},
                "objects": [)" +
            with_material + "]}");
        for (const char* name : {"a.json", "a.pov"}) {
            const std::filesystem::path path = directory.path() / name;
            export_scene(path, scene);
            CAPTURE(name, tests::content_of(path));
            const core::Scene again = load_scene(path);
            REQUIRE(again.shape_count() == scene.shape_count());
            if (path.extension() == ".pov") continue; // describes lights and shading differently
            CHECK(parts_of(again) == parts_of(scene));
            CHECK(again.solids().nodes().size() == scene.solids().nodes().size());
            CHECK((image_of(again) == image_of(scene)));
        }
    }
}
