#include "scenes/images/reader.hpp"
#include "simd/isa/isa.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace raylane;
using namespace raylane::tests;

namespace {

/// Renders an image and returns its bytes. The rendering must succeed.
std::string bytes_of(const ToolFixture& fixture, const std::string& name, const Options& options) {
    const Outcome outcome = fixture.render(name, options);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
    return content_of(fixture.path() / name);
}

scenes::Image rendered(const ToolFixture& fixture, const Options& options,
                       const std::string& name = "picture.pfm") {
    return fixture.rendered(name, options);
}

/// Returns red, green and blue of a pixel.
std::vector<float> pixel(const scenes::Image& image, int x, int y) {
    const auto first = static_cast<std::size_t>(3 * (y * image.width + x));
    return {image.rgb[first], image.rgb[first + 1], image.rgb[first + 2]};
}

/// A mirror that reflects half of a blue background.
const std::string mirror = R"({
    "image": {"width": 5, "height": 5},
    "camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
    "background": [0, 0, 0.5],
    "lights": [{"type": "directional", "direction": [0, 0, -1]}],
    "objects": [{"type": "disc", "center": [0, 0, 0], "normal": [0, 0, 1], "radius": 1,
                 "material": {"ambient": 0, "diffuse": 0, "reflectivity": 0.5}}]
})";

} // namespace

TEST_CASE("an image file does not depend on the number of threads") {
    const ToolFixture fixture;
    for (const char* name : {"picture.png", "picture.hdr", "picture.pfm"})
        for (const Options& engine : {Options{},
                                      {"--engine", "reference"},
                                      {"--engine", "reference", "--precision", "robust"}}) {
            const Options options = joined({"--size", "100x70", "--spp", "4"}, engine);
            const std::string one = bytes_of(fixture, name, joined(options, {"--threads", "1"}));
            CHECK(!one.empty());
            CHECK(one == bytes_of(fixture, name, joined(options, {"--threads", "4"})));
            CHECK(one == bytes_of(fixture, name, joined(options, {"--threads", "100"})));
            CHECK(one == bytes_of(fixture, name, options));
            if (engine.empty())
                CHECK(one == bytes_of(fixture, name, joined(options, {"--tile", "8"})));
        }
}

TEST_CASE("the size and the samples and the transfer can be overridden") {
    const ToolFixture fixture;
    CHECK(rendered(fixture, {}).width == 16);
    CHECK(rendered(fixture, {}).height == 12);
    const scenes::Image other = rendered(fixture, {"--size", "7x9"});
    CHECK(other.width == 7);
    CHECK(other.height == 9);

    const std::string one = bytes_of(fixture, "one.pfm", {}),
                      nine = bytes_of(fixture, "nine.pfm", {"--spp", "9"});
    CHECK(one.size() == nine.size());
    CHECK(one != nine);
    std::string sampled = ball;
    sampled.insert(1, R"("sampling": {"grid": 3}, )");
    CHECK(bytes_of(ToolFixture(sampled), "nine.pfm", {}) == nine);
    CHECK(bytes_of(ToolFixture(sampled), "one.pfm", {"--spp", "1"}) == one);

    const std::string good = bytes_of(fixture, "good.pfm", {"--quality", "40"});
    CHECK(good != one);
    sampled = ball;
    sampled.insert(1, R"("sampling": {"grid": 3, "quality": 40}, )");
    CHECK(bytes_of(ToolFixture(sampled), "good.pfm", {}) == good);
    CHECK(bytes_of(ToolFixture(sampled), "nine.pfm", {"--spp", "9"}) == nine);

    // The background's blue is 0.5.
    CHECK(pixel(rendered(fixture, {"--transfer", "linear"}, "p.png"), 0, 0)[2] == 128.0F / 255.0F);
    CHECK(pixel(rendered(fixture, {"--transfer", "srgb"}, "p.png"), 0, 0)[2] == 188.0F / 255.0F);
    CHECK(pixel(rendered(fixture, {}, "p.png"), 0, 0)[2] == 188.0F / 255.0F);
    CHECK(bytes_of(fixture, "p.pfm", {"--transfer", "linear"}) == one);
}

TEST_CASE("the limits can be overridden") {
    const ToolFixture fixture(mirror);
    const auto center = [&](const Options& options) {
        return pixel(rendered(fixture, options), 2, 2);
    };
    const std::vector<float> black = {0.0F, 0.0F, 0.0F}, reflected = {0.0F, 0.0F, 0.25F};
    CHECK(center({}) == reflected);
    CHECK(center({"--max-depth", "1"}) == reflected);
    CHECK(center({"--max-depth", "0"}) == black);
    CHECK(center({"--min-weight", "0"}) == reflected);
    CHECK(center({"--min-weight", "0.5"}) == reflected);
    CHECK(center({"--min-weight", "0.75"}) == black);
    CHECK(pixel(rendered(fixture, {"--max-depth", "0"}), 0, 0)[2] == 0.5F);
}

TEST_CASE("an image without a name has the scene's in the current folder") {
    const ToolFixture fixture;
    std::filesystem::create_directory(fixture.path() / "far");
    fixture.write("far/ball.v2.json", ball);
    CHECK(fixture.run({"render", "far/ball.v2.json"}).code == 0);
    CHECK(scenes::read_image(fixture.path() / "ball.v2.png").rgb.floats() ==
          rendered(fixture, {}, "same.png").rgb.floats());
    CHECK(std::distance(std::filesystem::directory_iterator(fixture.path() / "far"), {}) == 1);
}

TEST_CASE("the figures of a rendering are JSON") {
    const ToolFixture fixture;
    const auto stats = [&](const Options& options) {
        REQUIRE(fixture.render("out/p.png", joined(options, {"--stats", "out/s.json"})).code == 0);
        return nlohmann::ordered_json::parse(content_of(fixture.output() / "s.json"));
    };
    const nlohmann::ordered_json figures =
        stats({"--size", "8x6", "--spp", "4", "--threads", "1", "--engine", "reference",
               "--precision", "robust", "--max-depth", "3", "--min-weight", "0.1"});
    std::vector<std::string> keys;
    for (const auto& [key, value] : figures.items())
        keys.push_back(key);
    CHECK(keys == std::vector<std::string>{"version",
                                           "scene",
                                           "engine",
                                           "isa",
                                           "precision",
                                           "threads",
                                           "ranks",
                                           "width",
                                           "height",
                                           "quality",
                                           "samples_per_pixel",
                                           "max_depth",
                                           "min_weight",
                                           "scene_fingerprint",
                                           "options_fingerprint",
                                           "pixels_fingerprint",
                                           "shapes",
                                           "scene_bytes",
                                           "seconds",
                                           "rays",
                                           "rays_per_second",
                                           "nodes_visited",
                                           "shapes_tested",
                                           "tests_beyond_double",
                                           "shadow_rays_walked",
                                           "searches",
                                           "rays_refined",
                                           "left_to_the_reference",
                                           "legend"});
    CHECK(figures["version"] == RAYLANE_VERSION);
    CHECK(figures["scene"] == "scene.json");
    CHECK(figures["engine"] == "reference");
    CHECK(figures["precision"] == "robust");
    CHECK(figures["threads"] == 1);
    CHECK(figures["ranks"] == 1);
    CHECK(figures["width"] == 8);
    CHECK(figures["height"] == 6);
    CHECK(figures["quality"] == 0);
    CHECK(figures["samples_per_pixel"] == 4);
    CHECK(figures["max_depth"] == 3);
    CHECK(figures["min_weight"].dump() == "0.1");
    CHECK(figures["shapes"] == 1);
    CHECK(figures["rays"]["primary"] == 8 * 6 * 4);
    CHECK(figures["rays"]["reflected"] > 0);
    CHECK(figures["rays"]["refracted"] == 0);
    CHECK(figures["rays"]["total"] == figures["rays"]["primary"].get<int>() +
                                          figures["rays"]["reflected"].get<int>() +
                                          figures["rays"]["shadow"].get<int>());
    // The reference has one way to search.
    CHECK(figures["searches"]["shape_by_shape"] == 0);
    const nlohmann::ordered_json vector = stats({"--engine", "vector"});
    CHECK(vector["searches"]["shape_by_shape"].get<int>() +
              vector["searches"]["frusta"].get<int>() >=
          vector["rays"]["primary"].get<int>());
    for (const char* phase : {"load", "render", "write"})
        CHECK(figures["seconds"][phase] >= 0.0);
    CHECK(stats({"--threads", "4"})["rays"] == stats({"--threads", "1"})["rays"]);
    CHECK(stats({"--threads", "4"})["threads"] == 4);

    // A scene's name may have any bytes.
    fixture.write("b\xFF\n.json", ball);
    CHECK(
        fixture.run({"render", "b\xFF\n.json", "-o", "out/p.png", "--stats", "out/s.json"}).code ==
        0);
    CHECK(nlohmann::json::parse(content_of(fixture.output() / "s.json"))["scene"] ==
          "b\\xFF\\x0A.json");
}

TEST_CASE("fingerprints depend on scene and options and not on threads or tiles") {
    const ToolFixture fixture;
    const auto fingerprints = [&](const Options& options) {
        REQUIRE(fixture.render("a.png", joined(options, {"--stats", "s.json"})).code == 0);
        const auto stats = nlohmann::json::parse(content_of(fixture.path() / "s.json"));
        std::vector<std::string> lines;
        const scenes::Image image = scenes::read_image(fixture.path() / "a.png");
        for (const auto& [name, key] : {std::pair{"Scene", "scene_fingerprint"},
                                        {"Options", "options_fingerprint"},
                                        {"Pixels", "pixels_fingerprint"}}) {
            lines.push_back(stats[key]);
            CHECK(std::find(image.texts.begin(), image.texts.end(),
                            std::pair<std::string, std::string>(name, lines.back())) !=
                  image.texts.end());
        }
        return lines;
    };
    const std::vector<std::string> usual = fingerprints({});
    const std::string narrowest(simd::name_of(simd::narrowest_isa()));
    for (const Options& options :
         {Options{"--threads", "3"}, {"--tile", "8"}, {"--isa", narrowest}, {"--bits", "16"}})
        CHECK(fingerprints(options) == usual);
    for (const Options& options :
         {Options{"--spp", "9"}, {"--outline", "2"}, {"--alpha"}, {"--precision", "robust"}}) {
        CAPTURE(options);
        const std::vector<std::string> others = fingerprints(options);
        CHECK(others[0] == usual[0]);
        CHECK(others[1] != usual[1]);
    }
}

TEST_CASE("one frame of several can be rendered with figures") {
    const ToolFixture fixture;
    fixture.write("move.xyz", "2\n\nC 0 0 0\nO 0 0 1\n3\n\nC 0 0 0\nO 0 1 1\nO 0 2 2\n");
    const Options frame = {"render", "move.xyz", "--frames", "-1", "-o",      "f%d.png", "--size",
                           "20x10",  "--spp",    "4",        "-q", "--style", "spheres", "--stats"};
    const Outcome outcome = fixture.run(joined(frame, {"s.json"}));
    CHECK(outcome.err.empty());
    REQUIRE(outcome.code == 0);
    CHECK(std::filesystem::exists(fixture.path() / "f1.png"));
    const auto stats = nlohmann::json::parse(content_of(fixture.path() / "s.json"));
    CHECK(stats["scene"] == "move.xyz");
    CHECK(stats["shapes"] == 3);
    CHECK(stats["width"] == 20);
    CHECK(stats["samples_per_pixel"] == 4);
    CHECK(stats["rays"]["primary"] == 20 * 10 * 4);
    CHECK(fixture.run(joined(frame, {"f1.png"})).err ==
          "raylane: --stats: must be another file than --output, got \"f1.png\"\n");
    CHECK(fixture
              .run({"render", "move.xyz", "--frames", "0:1", "-o", "out/f%d.png", "--stats",
                    "s.json"})
              .err == "raylane: --stats: goes with a single image, without --turn, ranges of "
                      "--frames and sweeps of --set\n");
}

TEST_CASE("an image and its figures cannot go into one stream") {
    const ToolFixture fixture;
    const auto refused = [&](const Options& options, const std::string& got,
                             const std::string& out = "") {
        Setup setup;
        setup.out = out;
        const Outcome outcome = fixture.run(joined({"render", "scene.json"}, options), setup);
        CAPTURE(options, outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(outcome.err ==
              "raylane: --stats: must be another file than --output, got \"" + got + "\"\n");
    };
    const std::string file = fixture.write("f", "").string();
    for (const std::string& out : {std::string(), file}) { // a pipe or a file
        refused({"-o", "-", "--stats", "/dev/stdout"}, "/dev/stdout", out);
        refused({"-o", "-", "--stats", "/dev/fd/1"}, "/dev/fd/1", out);
    }
    refused({"-o", "-", "--stats", "f"}, "f", file);
    CHECK(std::filesystem::file_size(file) == 0);
    Setup nowhere;
    nowhere.out = "/dev/null";
    CHECK(fixture.run({"render", "scene.json", "-o", "-", "--stats", "/dev/null"}, nowhere).code ==
          0);
    CHECK(fixture.run({"render", "scene.json", "-o", "-", "--stats", "s.json"}).code == 0);
}

TEST_CASE("an image can be written to a pipe or a device") {
    const ToolFixture fixture;
    std::filesystem::create_symlink("/dev/stdout", fixture.path() / "stdout.pfm");
    const Outcome outcome = fixture.run({"render", "scene.json", "-o", "stdout.pfm"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out == bytes_of(fixture, "picture.pfm", {}));
    CHECK(std::filesystem::is_symlink(fixture.path() / "stdout.pfm"));
}
