#include "core/scene/pattern_place.hpp"
#include "scenes/export/export.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/images/writer.hpp"
#include "scenes/tool/checkpoint/fingerprint.hpp"
#include "tests/places.hpp"
#include "tests/scenes/export/exports.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <variant>

using namespace raylane;
using namespace raylane::tests;

namespace {

/// Writes a PNG of two columns and a row, with a first colour.
void write_png(const std::filesystem::path& path, const core::Color& first, int bits = 8,
               float alpha = 1.0F) {
    scenes::OutputFile file(path);
    core::Film film(2, 1, alpha != 1.0F);
    film.at(0, 0) = first;
    film.at(1, 0) = core::Color(1.0F);
    if (film.has_alpha()) film.alpha_at(0, 0) = film.alpha_at(1, 0) = alpha;
    scenes::ImageOptions options;
    options.bits = bits;
    file.reserve(2, 1);
    file.commit(film, options);
}

/// Returns a scene with an image on a sphere in a rotated group.
std::string scene_with(const std::string& pattern, const std::string& group = "") {
    return R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]}, "image": {"width": 20, "height": 15},
        "lights": [{"type": "point", "position": [0, 0, 9]}],
        "materials": {"a": {"pattern": )" +
           pattern + R"(}}, "objects": [{"type": "group", )" + group +
           R"("objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "a"},
               {"type": "cylinder", "base": [2, 0, 0], "axis": [0, 1, 0], "radius": 0.5,
                "material": "a"}]}]})";
}

const std::string image = R"({"type": "image", "file": "sky.png"})";

} // namespace

TEST_CASE("a scene reads the PNG beside it, once for all materials") {
    const TemporaryDirectory directory;
    write_png(directory.path() / "sky.png", {0.5F, 0.25F, 0.0F});
    const auto path =
        directory.write("scene.json", R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
        "materials": {"a": {"pattern": {"type": "image", "file": "sky.png"}},
            "b": {"pattern": {"type": "image", "file": "./sky.png", "width": 2, "height": 3,
                              "wrap": "clamp", "axis": [1, 0, 0]}}}, "objects": []})");
    const core::Scene scene = scenes::load_scene(path);
    const core::Pattern &a = scene.materials()[0].pattern, &b = scene.materials()[1].pattern;
    CHECK(a.image.width() == 2);
    CHECK(a.image.height() == 1);
    CHECK(core::largest_component(a.image.pixel(0, 0) - core::Vec3d(0.5, 0.25, 0.0)) < 0.004);
    CHECK(a.image.pixel(1, 0) == core::Vec3d(1.0));
    CHECK(&a.image.components() == &b.image.components());
    CHECK(b.width == 2.0F);
    CHECK(b.height == 3.0F);
    CHECK(b.wrap == core::ImageWrap::clamp);
    CHECK(b.axis == core::Vec3f(1, 0, 0));
}

TEST_CASE("images of 16 bits keep their precision") {
    const TemporaryDirectory directory;
    write_png(directory.path() / "sky.png", {0.5F, 0.2503F, 0.0F}, 16);
    const core::Scene scene = scenes::load_scene(directory.write("scene.json", scene_with(image)));
    const core::Texture& texture = scene.materials()[0].pattern.image;
    CHECK(std::holds_alternative<core::Texture::Floats>(texture.components()));
    CHECK(core::largest_component(texture.pixel(0, 0) - core::Vec3d(0.5, 0.2503, 0.0)) < 1e-4);
}

TEST_CASE("a mistake about an image names file and field") {
    const TemporaryDirectory directory;
    const auto complaint = [&](const std::string& file) {
        return complaint_about(directory.write(
            "scene.json", scene_with(R"({"type": "image", "file": ")" + file + "\"}")));
    };
    const std::string field = "/materials/a/pattern/file: must be the name of a ";
    CHECK(complaint("none.png").starts_with(field + "file, got \"none.png\", but "));
    CHECK(complaint("none.png").ends_with("none.png does not exist"));
    CHECK(complaint(".").ends_with("is a directory"));
    directory.write("text.png", "This is no image.");
    const std::string of_text = complaint("text.png");
    CHECK(of_text.starts_with(field + "PNG image, got \"text.png\", but "));
    CHECK(of_text.ends_with("text.png must be PNG, got another format"));
    write_png(directory.path() / "pane.png", core::Color(0.5F), 8, 0.5F);
    CHECK(complaint("pane.png").ends_with("must have no transparent pixels"));
    write_png(directory.path() / "whole.png", core::Color(0.5F));
    const std::string bytes = content_of(directory.path() / "whole.png");
    directory.write("half.png", bytes.substr(0, bytes.size() / 2));
    CHECK(complaint("half.png").starts_with(field + "PNG image, got \"half.png\""));
    std::string huge = bytes;
    huge[16] = huge[20] = 0;
    huge[17] = huge[21] = 1; // 65,536 x 65,536 pixels
    directory.write("huge.png", huge);
    CHECK(complaint("huge.png").find("must have at most 67108864 pixels") != std::string::npos);
    CHECK(complaint("whole.png") == "");
    CHECK(complaint_about(directory.write("scene.json", scene_with(R"({"type": "image"})")))
              .starts_with("/materials/a/pattern: must have the key \"file\""));
}

TEST_CASE("JSON keeps images by their names, relative to the new file") {
    const TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "copies");
    write_png(directory.path() / "sky.png", {0.5F, 0.25F, 0.0F});
    const core::Scene scene = scenes::load_scene(directory.write("scene.json", scene_with(image)));
    for (const char* name : {"copy.json", "copies/copy.json"}) {
        const std::filesystem::path copy = directory.path() / name;
        CHECK(scenes::export_scene(copy, scene).empty());
        CHECK(image_of(scenes::load_scene(copy)) == image_of(scene));
    }
    CHECK(content_of(directory.path() / "copy.json").find("\"sky.png\"") != std::string::npos);
    CHECK(content_of(directory.path() / "copies/copy.json").find("\"../sky.png\"") !=
          std::string::npos);
    const std::filesystem::path built = directory.path() / "scene.rl";
    CHECK(tests::complaint(built, scene).find("cannot store images") != std::string::npos);
    CHECK(scenes::export_scene(directory.path() / "copy.pov", scene) ==
          std::vector<std::string>{"images on surfaces"});
}

TEST_CASE("files refuse patterns that have moved with objects, and keep others") {
    const TemporaryDirectory directory;
    write_png(directory.path() / "sky.png", {0.5F, 0.25F, 0.0F});
    const std::string cells = R"({"type": "checker", "colors": ["#000000", "#ffffff"], "size": 0.2,
                                  "space": "object"})";
    const std::filesystem::path copy = directory.path() / "copy.json";
    for (const std::string& pattern : {image, cells}) {
        const core::Scene moved = scenes::load_scene(
            directory.write("scene.json", scene_with(pattern, R"("rotate": [10, 20, 30], )")));
        for (const char* name : {"copy.json", "copy.rl"})
            CHECK(tests::complaint(directory.path() / name, moved).find("cannot store ") !=
                  std::string::npos);
        const core::Scene still =
            scenes::load_scene(directory.write("scene.json", scene_with(pattern)));
        CHECK(scenes::export_scene(copy, still).empty());
        CHECK(image_of(scenes::load_scene(copy)) == image_of(still));
        CHECK_FALSE(image_of(moved) == image_of(still));
    }
}

TEST_CASE("fingerprints change with pixels and with moved patterns, not with names of images") {
    const TemporaryDirectory directory;
    const auto fingerprint = [&](const std::string& text) {
        return scenes::fingerprint_of(scenes::load_scene(directory.write("scene.json", text)));
    };
    write_png(directory.path() / "sky.png", {0.5F, 0.25F, 0.0F});
    write_png(directory.path() / "same.png", {0.5F, 0.25F, 0.0F});
    const std::string own = fingerprint(scene_with(image));
    CHECK(fingerprint(scene_with(image)) == own);
    CHECK(fingerprint(scene_with(R"({"type": "image", "file": "same.png"})")) == own);
    CHECK(fingerprint(scene_with(R"({"type": "image", "file": "sky.png", "width": 2})")) != own);
    // The balls of these scenes have the same numbers.
    const auto turned = [&](const std::string& degrees) {
        return fingerprint(R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]}, "lights": [],
            "materials": {"a": {"pattern": )" +
                           image + R"(}}, "objects": [{"type": "sphere",
            "center": [0, 0, 0], "radius": 1, "material": "a", "rotate": [0, )" +
                           degrees + ", 0]}]}");
    };
    CHECK(turned("90") == turned("90"));
    CHECK(turned("90") != turned("180"));
    write_png(directory.path() / "sky.png", {0.5F, 0.5F, 0.0F});
    CHECK(fingerprint(scene_with(image)) != own);
}

TEST_CASE("materials may follow the objects whose transforms their patterns follow") {
    const TemporaryDirectory directory;
    write_png(directory.path() / "sky.png", {0.5F, 0.25F, 0.0F});
    const auto scene = [&](bool first) {
        const std::string materials = R"("materials": {"a": {"pattern": )" + image + "}}",
                          objects = R"("objects": [{"type": "sphere", "center": [0, 0, 0],
            "radius": 1, "material": "a", "rotate": [20, 30, 0]}])";
        return scenes::load_scene(directory.write(
            "scene.json", R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
            "lights": [{"type": "point", "position": [0, 0, 9]}], )" +
                              (first ? materials + ", " + objects : objects + ", " + materials) +
                              "}"));
    };
    CHECK(scene(false).object_spaces().size() == 1);
    CHECK(image_of(scene(false)) == image_of(scene(true)));
}

TEST_CASE("an image follows definitions, instances and placements") {
    const TemporaryDirectory directory;
    write_png(directory.path() / "sky.png", {0.5F, 0.25F, 0.0F});
    const auto image_with = [&](const std::string& objects) {
        return image_of(scenes::load_scene(
            directory.write("scene.json", R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
            "lights": [{"type": "point", "position": [0, 0, 9]}],
            "materials": {"a": {"pattern": )" +
                                              image + R"(}},
            "definitions": {"ball": {"type": "sphere", "center": [0, 0, 0], "radius": 1}},
            "objects": [)" + objects + "]}")));
    };
    const auto turned = image_with(R"({"type": "sphere", "center": [0, 0, 0], "radius": 1,
        "material": "a", "rotate": [0, 90, 0], "translate": [1, 0, 0]})");
    CHECK(turned == image_with(R"({"type": "instance", "of": "ball", "material": "a",
        "rotate": [0, 90, 0], "translate": [1, 0, 0]})"));
    CHECK(turned == image_with(R"({"type": "instance", "of": "ball", "material": "a",
        "placements": [{"rotate": [0, 90, 0], "translate": [1, 0, 0]}]})"));
    CHECK_FALSE(turned == image_with(R"({"type": "sphere", "center": [1, 0, 0], "radius": 1,
        "material": "a"})"));
}
