#include "scenes/export/export.hpp"
#include "scenes/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/exports.hpp"
#include "tests/scenes/json_scenes.hpp"

#include <filesystem>
#include <string>
#include <utility>

using namespace raylane;
using namespace raylane::scenes;
using tests::complaint;
using tests::picture_of;

TEST_CASE("solids are written as deep as they are read") {
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
              "cannot have a solid of more than 256 levels of objects and lists, for none is read, "
              "got 258"},
          Row{box, "a.json", 127,
              "cannot have a solid of more than 256 levels of objects and lists, for none is read, "
              "got 257"},
          Row{ball, "a.pov", 125,
              "cannot have solids that are nested more than 125 deep, for none is read, got 126"},
          Row{box, "a.pov", 125,
              "cannot have solids that are nested more than 125 deep, for none is read, got "
              "126"}}) {
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
    "objects": [
        {"type": "difference", "material": "clay", "objects": [
            {"type": "intersection", "objects": [
                {"type": "box", "min": [-1, -1, -1], "max": [1, 1, 1]},
                {"type": "sphere", "center": [0, 0, 0], "radius": 1.3, "material": "red"}]},
            {"type": "difference", "objects": [
                {"type": "cylinder", "base": [0, 0, 0], "axis": [0, 2, 0], "radius": 0.6},
                {"type": "union", "objects": [
                    {"type": "plane", "point": [0, 0.1, 0], "normal": [1, 2, 0.5]},
                    {"type": "ellipsoid", "center": [0, 0.4, 0], "axes": [[0.3, 0, 0], [0, 0.2, 0], [0, 0, 0.5]]}]}]}]},
        {"type": "clip", "material": "glass", "objects": [
            {"type": "union", "objects": [
                {"type": "cone", "base": [2, 0, 0], "axis": [0, 1, 0], "base_radius": 0.5},
                {"type": "sphere", "center": [2, 0.4, 0], "radius": 0.4}]},
            {"type": "plane", "point": [2, 0, 0.1], "normal": [0, 0, 1]},
            {"type": "difference", "objects": [
                {"type": "box", "min": [1, -1, -1], "max": [3, 2, 1]},
                {"type": "sphere", "center": [2, 0.9, 0], "radius": 0.4}]}]},
        {"type": "intersection", "material": "clay", "objects": [
            {"type": "quadric", "center": [-2, 0, 1], "matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, -0.1]]},
            {"type": "box", "min": [-3, -0.5, 0], "max": [-1, 0.5, 2]}]}
    ]})";

} // namespace

TEST_CASE("solids of others are written as they were, and stay the same picture") {
    const tests::TemporaryDirectory directory;
    const core::Scene scene = tests::scene_of(solids);
    const std::filesystem::path path = directory.path() / "solids.json";
    export_scene(path, scene);
    const core::Scene again = load_scene(path);
    CHECK(again.solids().nodes().size() == scene.solids().nodes().size());
    CHECK(picture_of(again) == picture_of(scene));
    const std::string once = tests::content_of(path);
    export_scene(path, again);
    CHECK(tests::content_of(path) == once);

    const std::filesystem::path pov = directory.path() / "solids.pov";
    export_scene(pov, scene);
    const std::string text = tests::content_of(pov);
    for (const char* word : {"difference { intersection { box {", "merge { cone {",
                             "clipped_by { difference { plane {", "difference { cylinder {",
                             "intersection { quadric {"}) {
        INFO(word << " in " << text);
        CHECK(text.find(word) != std::string::npos);
    }
    CHECK(complaint(directory.path() / "solids.nff", scene)
              .find("has no word for a solid that is made of others: .pov and .json have") !=
          std::string::npos);
}
