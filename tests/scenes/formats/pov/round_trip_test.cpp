#include "scenes/export/export.hpp"
#include "scenes/export/writers.hpp"
#include "scenes/formats/scene_file.hpp"
#include "simd/wavefront/render.hpp"
#include "tests/places.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

using namespace raylane;
using namespace raylane::scenes;

namespace {

struct Copy {
    core::Scene scene;
    std::vector<std::string> left_out, remarks;
};

Copy by_way_of_pov(const core::Scene& scene) {
    const tests::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "copy.pov";
    std::vector<std::string> left_out = export_scene(path, scene), remarks;
    LoadOptions options;
    options.on_remark = [&](const std::string& remark) { remarks.push_back(remark); };
    return {load_scene(path, options), std::move(left_out), std::move(remarks)};
}

/// Returns kind and numbers of each shape that is not part of a solid.
std::vector<float> numbers_in(const core::Scene& scene) {
    std::vector<float> floats;
    for_each_by_id(scene, [&](const auto& shape, core::ShapeId) {
        floats.push_back(static_cast<float>(core::kind_of<std::decay_t<decltype(shape)>>));
        for (const auto number : core::numbers_of(shape))
            floats.push_back(static_cast<float>(number));
    });
    return floats;
}

core::Film image_of(const core::Scene& scene, const core::Settings& like) {
    core::Settings settings = like;
    settings.height = 96 * like.height / like.width;
    settings.width = 96;
    settings.grid = 1;
    settings.quality = 0.0F;
    settings.samples = core::SamplePattern::regular;
    settings.filter = core::PixelFilter::box;
    return simd::render(scene, settings, {}).film;
}

/// Returns the number of pixels that differ by more than the last bits of a material can cause.
std::size_t differing(const core::Scene& a, const core::Scene& b) {
    const core::Film first = image_of(a, a.settings()), second = image_of(b, a.settings());
    std::size_t count = 0;
    for (std::size_t i = 0; i < first.pixels().size(); ++i) {
        const core::Color off = first.pixels()[i] - second.pixels()[i];
        if (std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) > 1e-4F) ++count;
    }
    return count;
}

} // namespace

TEST_CASE("a scene exported to POV-Ray's language reads back unchanged") {
    for (const auto& entry : std::filesystem::directory_iterator(
             std::filesystem::path(RAYLANE_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".json" || entry.path().stem().extension() == ".schema")
            continue;
        CAPTURE(entry.path().filename());
        const core::Scene scene = load_scene(entry.path());
        const Copy copy = by_way_of_pov(scene);
        CHECK(copy.remarks.empty());
        const std::vector<float> before = numbers_in(scene), after = numbers_in(copy.scene);
        REQUIRE(after.size() == before.size());
        for (std::size_t i = 0; i < after.size(); ++i)
            if (after[i] != Approx(before[i]).epsilon(1e-6).margin(1e-6)) FAIL_CHECK(i);
        CHECK(copy.scene.shape_count() == scene.shape_count());
        CHECK(copy.scene.camera().from == scene.camera().from);
        CHECK(copy.scene.camera().at == scene.camera().at);
        CHECK(copy.scene.camera().up == scene.camera().up);
        CHECK(copy.scene.camera().field_of_view ==
              Approx(scene.camera().field_of_view).epsilon(1e-6));
        CHECK(copy.scene.camera().height == scene.camera().height);
        CHECK(copy.scene.settings().width == scene.settings().width);
        CHECK(copy.scene.settings().height == scene.settings().height);
        CHECK(copy.scene.settings().max_depth == scene.settings().max_depth);
        CHECK(copy.scene.settings().transfer == scene.settings().transfer);
        // All of these scenes show gradients between their ends alone.
        const bool is_whole =
            std::all_of(copy.left_out.begin(), copy.left_out.end(), [](const std::string& words) {
                return words.find("gradients") != std::string::npos;
            });
        if (is_whole) CHECK(differing(scene, copy.scene) == 0);
    }
}

TEST_CASE("solids and materials read back from POV-Ray's language unchanged") {
    const core::Scene scene = tests::scene_of(R"({"camera": {"from": [4, 5, 6], "at": [0, 0, 0]},
    "image": {"width": 96, "height": 72},
    "lights": [{"type": "point", "position": [30, 40, 50], "color": [0.5, 0.5, 0.5]},
               {"type": "directional", "direction": [-1, -3, -0.5], "color": [0.5, 0.5, 0.25]},
               {"type": "sphere", "position": [-3, 8, 9], "radius": 0.5, "color": [40, 40, 40]}],
    "materials": {"clay": {"specular": 0.5, "exponent": 64},
        "glass": {"transmission": 1, "ambient": 0, "diffuse": 0, "reflection": "dielectric", "index": 1.25},
        "tint": {"transmission": 0.75, "index": 1, "reflectivity": 0.125},
        "pane": {"opacity": 0.25, "color": [0, 0.5, 1], "specular": 0.5, "reflectivity": 0.25},
        "red": {"color": [1, 0, 0], "reflectivity": 0.25},
        "floor": {"pattern": {"type": "checker", "colors": ["#ffffff", "#305070"], "size": 0.75,
                              "upper_edges": "z"}},
        "bands": {"pattern": {"type": "stripes", "colors": [[1, 0, 0], [0, 1, 0]], "width": 0.25,
                              "direction": [1, 2, 3]}}},
    "objects": [
        {"type": "plane", "point": [0, -2, 0], "normal": [0, 1, 0], "material": "floor"},
        {"type": "sphere", "center": [1, -1, 2], "radius": 0.5, "material": "bands"},
        {"type": "sphere", "center": [-1, 1.5, 2], "radius": 0.5, "material": "tint"},
        {"type": "sphere", "center": [1.5, 1.5, 2], "radius": 0.75, "material": "pane"},
        {"type": "clip", "material": "clay", "objects": [
            {"type": "union", "objects": [
                {"type": "sphere", "center": [0, -1, 3], "radius": 0.5},
                {"type": "sphere", "center": [0.4, -1, 3], "radius": 0.5}]},
            {"type": "plane", "point": [0, -1, 3], "normal": [0, 1, 0]}]},)" +
                                              tests::three_solids + "]}");
    const Copy copy = by_way_of_pov(scene);
    CHECK(copy.left_out.empty());
    CHECK(copy.remarks.empty());
    CHECK(differing(scene, copy.scene) == 0);
}
