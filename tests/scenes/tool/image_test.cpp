#include "scenes/images/exr.hpp"
#include "scenes/images/reader.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

/// Tests of options for the rendered part of an image and for its file.
using namespace raylane;
using namespace raylane::tests;

namespace {

std::string error_of(const ToolFixture& fixture, const std::string& name, const Options& options) {
    const Outcome outcome = fixture.render(name, options);
    CHECK(outcome.code == 2);
    CHECK(is_one_line(outcome.err));
    CHECK(!std::filesystem::exists(fixture.path() / name));
    return outcome.err;
}

} // namespace

TEST_CASE("a crop has the pixels of the whole image") {
    const ToolFixture fixture;
    for (const Options& sampling : {Options{"--spp", "4"}, {"--quality", "40"}}) {
        const Options options = joined(sampling, {"--size", "40x30", "--outline", "2"});
        const scenes::Image whole_image = fixture.rendered("whole.pfm", options);
        const scenes::Image part =
            fixture.rendered("part.pfm", joined(options, {"--crop", "7,3,21x19"}));
        REQUIRE(part.width == 21);
        REQUIRE(part.height == 19);
        for (int y = 0; y < 19; ++y)
            for (int i = 0; i < 3 * 21; ++i)
                CHECK(part.rgb[static_cast<std::size_t>(3 * 21 * y + i)] ==
                      whole_image.rgb[static_cast<std::size_t>(3 * 40 * (y + 3) + 3 * 7 + i)]);
    }
}

TEST_CASE("an image records how it was made but not where or when") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png", {"--spp", "4", "--dpi", "300"}).code == 0);
    REQUIRE(fixture.render("b.png", {"--spp", "4", "--dpi", "300", "--threads", "1"}).code == 0);
    const std::string content = content_of(fixture.path() / "a.png");
    CHECK(content == content_of(fixture.path() / "b.png"));
    CHECK(content.find("scene.json") != std::string::npos);
    CHECK(content.find("raylane " RAYLANE_VERSION) != std::string::npos);
    CHECK(content.find("--size 16x12 --spp 4 ") != std::string::npos);
    CHECK(content.find("pHYs") != std::string::npos);
    CHECK(content.find(fixture.path().string()) == std::string::npos);
}

TEST_CASE("outlines are rendered by the scene's settings or the command line's") {
    std::string outlined = ball;
    outlined.insert(1, R"("outline": {"width": 2, "color": "#00ff00"}, )");
    const ToolFixture plain, with_outline(outlined);
    const auto bytes_of = [](const ToolFixture& fixture, const Options& options) {
        REQUIRE(fixture.render("a.pfm", options).code == 0);
        return content_of(fixture.path() / "a.pfm");
    };
    const Options asked = {"--outline", "2", "--outline-color", "lime"};
    CHECK(bytes_of(with_outline, {}) == bytes_of(plain, asked));
    CHECK(bytes_of(with_outline, {}) != bytes_of(plain, {}));
    CHECK(bytes_of(with_outline, {"--outline", "0"}) == bytes_of(plain, {}));
}

TEST_CASE("the option --alpha leaves the background out") {
    std::string without = ball;
    without.replace(without.find("\"width\""), 0, "\"alpha\": true, ");
    const ToolFixture fixture, by_scene(without);
    const scenes::Image asked = fixture.rendered("a.png", {"--alpha"});
    REQUIRE(asked.alpha.size() == 16 * 12);
    CHECK(asked.alpha[0] == 0.0F);
    CHECK(asked.rgb[2] == 0.0F);
    CHECK(asked.alpha[6 * 16 + 8] == 1.0F);
    const scenes::Image own = by_scene.rendered("a.png", {});
    CHECK(own.rgb.is_same(asked.rgb));
    CHECK(own.alpha.is_same(asked.alpha));
    // The Comment has the option if it was given.
    const auto comment = [](const scenes::Image& image) {
        const auto found = std::find_if(image.texts.begin(), image.texts.end(),
                                        [](const auto& text) { return text.first == "Comment"; });
        return found == image.texts.end() ? "" : found->second;
    };
    CHECK(comment(asked) == comment(own) + " --alpha");
    CHECK(by_scene.run({"verify", "a.png", "scene.json", "--whole", "-q"}).code == 0);
    CHECK(fixture.run({"verify", "a.png", "scene.json", "--whole", "-q"}).code == 0);
    CHECK(fixture.rendered("b.png", {}).alpha.size() == 0);
    CHECK(fixture.run({"compare", "a.png", "a.png"}).code == 0);
    CHECK(fixture.run({"compare", "a.png", "b.png"}).code == 1);
    // Other formats show the image over black.
    CHECK(by_scene.rendered("a.pfm", {}).rgb[2] == 0.0F);
    CHECK(error_of(fixture, "a.pfm", {"--alpha"}) ==
          "raylane: --alpha: goes with PNG, TIFF or EXR\n");
    if (!scenes::has_exr()) return;
    const scenes::Image exr = fixture.rendered("a.exr", {"--alpha", "--bits", "32"});
    CHECK(exr.rgb.floats() == by_scene.rendered("a.pfm", {}).rgb.floats());
    CHECK(exr.alpha[6 * 16 + 8] == 1.0F);
}

TEST_CASE("options that an image cannot have give an error of one line") {
    const ToolFixture fixture;
    const std::string crop = "raylane: --crop: must be X,Y,WIDTHxHEIGHT in pixels from the upper "
                             "left corner, such as 100,50,320x240, got \"";
    for (const std::string text : {"", "1", "1,2", "1,2,3", "1,2,3x", "1,2,0x4", "-1,2,3x4",
                                   "1,2,3x4x5", "1,2,3,4", "a,b,cxd", "1,2,99999999999x3"})
        CHECK(error_of(fixture, "a.png", {"--crop", text}) == crop + text + "\"\n");
    CHECK(error_of(fixture, "a.png", {"--crop", "10,0,7x3"}) ==
          "raylane: --crop: must lie in the image of 16 x 12 pixels, got \"10,0,7x3\"\n");
    CHECK(error_of(fixture, "a.png", {"--aovs"}) ==
          "raylane: --aovs: goes with an output that ends in .exr\n");
    CHECK(error_of(fixture, "a.png", {"--layers"}) == // the former name
          "raylane: --aovs: goes with an output that ends in .exr\n");
    CHECK(error_of(fixture, "a.png", {"--max-see-through", "0"}) ==
          "raylane: --max-transparent: must be a whole number from 1 to 1000000, got \"0\"\n");
    CHECK(error_of(fixture, "a.pfm", {"--dpi", "300"}) ==
          "raylane: --dpi: goes with PNG, TIFF or EXR\n");
    CHECK(error_of(fixture, "a.hdr", {"--bits", "16"}) ==
          "raylane: --bits: goes with PNG, TIFF or EXR\n");
    CHECK(error_of(fixture, "a.png", {"--bits", "32"}) ==
          "raylane: --bits: must be 8 or 16 in PNG and TIFF, got \"32\"\n");
    CHECK(error_of(fixture, "a.png", {"--bits", "12"}) ==
          "raylane: --bits: must be 8, 16 or 32, got \"12\"\n");
    CHECK(error_of(fixture, "a.png", {"--dpi", "0"}) ==
          "raylane: --dpi: must be a number from 1 to 10000, got \"0\"\n");
    CHECK(error_of(fixture, "a.png", {"--outline", "33"}) ==
          "raylane: --outline: must be a number from 0 to 32, got \"33\"\n");
    CHECK(error_of(fixture, "a.png", {"--outline", "1", "--outline-color", "rde"}) ==
          "raylane: --outline-color: must be a colour such as black, #204060 or 0.1,0.2,0.3, got "
          "\"rde\", did you mean \"red\"?\n");
    CHECK(error_of(fixture, "a.png", {"--outline-color", "#ff0000"}) ==
          "raylane: --outline-color: goes with --outline\n");
}

TEST_CASE("AOVs are written to an EXR") {
    const ToolFixture fixture;
    if (!scenes::has_exr()) {
        CHECK(error_of(fixture, "a.exr", {}) == "raylane: --output: must be .png, .hdr or .pfm: "
                                                "raylane was built without libopenexr-dev\n");
        return;
    }
    CHECK(error_of(fixture, "a.exr", {"--bits", "8"}) ==
          "raylane: --bits: must be 16 or 32 in EXR, got \"8\"\n");
    const Options options = {"--aovs", "--bits", "32"};
    const scenes::Image image = fixture.rendered("a.exr", options);
    const scenes::Image floats = fixture.rendered("a.pfm", {});
    CHECK(image.rgb.floats() == floats.rgb.floats());
    CHECK(fixture.run({"compare", "a.exr", "a.pfm"}).code == 0);
    const std::string content = content_of(fixture.path() / "a.exr");
    for (const char* name : {"id.material", "id.shape", "samples", "N.X"})
        CHECK(content.find(name) != std::string::npos);
    REQUIRE(fixture.render("b.exr", joined(options, {"--threads", "3", "--tile", "8"})).code == 0);
    CHECK(content == content_of(fixture.path() / "b.exr"));
}
