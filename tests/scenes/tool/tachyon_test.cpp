#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

using namespace raylane::tests;

namespace {

/// A red ball that fills the image and is visible without lights.
const std::string red = "BEGIN_SCENE RESOLUTION 8 6 SPHERE CENTER 0 0 4 RAD 3 TEXTURE AMBIENT 1 "
                        "DIFFUSE 0 SPECULAR 0 OPACITY 1 COLOR 1 0.5 0 TEXFUNC 0 END_SCENE";

Outcome draw(const ToolFixture& fixture, const std::vector<std::string>& options) {
    return fixture.run(joined({"tachyon"}, options));
}

std::string bytes(std::initializer_list<int> codes) {
    std::string text;
    for (const int code : codes)
        text.push_back(static_cast<char>(code));
    return text;
}

} // namespace

TEST_CASE("raylane tachyon accepts the command line of the program tachyon") {
    const ToolFixture fixture;
    fixture.write("a.dat", red);
    // This is VMD's call. The order is free.
    const Outcome outcome =
        draw(fixture, {"-aasamples", "12", "a.dat", "-format", "TARGA", "-o", "out/a.dat.tga"});
    CHECK(outcome.err.empty());
    CHECK(outcome.out.empty());
    REQUIRE(outcome.code == 0);
    const std::string targa = content_of(fixture.output() / "a.dat.tga");
    CHECK(targa.size() >= 18 + 3 * 8 * 6);
    CHECK(targa.substr(0, 18) == bytes({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 6, 0, 24, 0}));
    CHECK(targa.substr(18, 3) == bytes({0, 128, 255})); // blue, green, red

    REQUIRE(draw(fixture, {"a.dat", "-res", "3", "2", "-format", "PPM", "-o", "out/a.ppm"}).code ==
            0);
    std::string ppm = "P6\n3 2\n255\n";
    for (int i = 0; i < 6; ++i)
        ppm += bytes({255, 128, 0});
    CHECK(content_of(fixture.output() / "a.ppm") == ppm);
    REQUIRE(draw(fixture, {"a.dat", "-format", "BMP", "-o", "out/a.bmp"}).code == 0);
    CHECK(content_of(fixture.output() / "a.bmp").starts_with("BM"));
    REQUIRE(draw(fixture, {"a.dat", "-o", "out/a.png"}).code == 0);
    CHECK(content_of(fixture.output() / "a.png").starts_with("\x89PNG"));
    REQUIRE(draw(fixture, {"a.dat", "-o", "out/a.picture"}).code == 0);
    CHECK(content_of(fixture.output() / "a.picture") == content_of(fixture.output() / "a.dat.tga"));
    REQUIRE(draw(fixture, {"a.dat"}).code == 0);
    CHECK(content_of(fixture.path() / "outfile.tga") == targa);
}

TEST_CASE("raylane tachyon takes tachyon's options") {
    const ToolFixture fixture;
    fixture.write("a.dat", red);
    const std::vector<std::string> options = {"+V",
                                              "-V",
                                              "-raydepth",
                                              "4",
                                              "-numthreads",
                                              "1",
                                              "-nobounding",
                                              "-boundthresh",
                                              "16",
                                              "-fullshade",
                                              "-mediumshade",
                                              "-lowestshade",
                                              "-lowshade",
                                              "-rescale_lights",
                                              "0.5",
                                              "-auto_skylight",
                                              "0.7",
                                              "-add_skylight",
                                              "0.7",
                                              "-skylight_samples",
                                              "4",
                                              "-shade_phong",
                                              "-shade_blinn",
                                              "-shade_blinn_fast",
                                              "-shade_nullphong",
                                              "-trans_max_surfaces",
                                              "3",
                                              "-trans_orig",
                                              "-trans_raster3d",
                                              "-trans_vmd",
                                              "-fog_radial",
                                              "-fog_vmd",
                                              "-shadow_filter_on",
                                              "-clamp"};
    const Outcome outcome = draw(fixture, joined(options, {"a.dat", "-o", "out/a.tga"}));
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    const Outcome useless =
        draw(fixture, {"-gamma", "2", "a.dat", "-normalize", "-normalfixup", "off"});
    CHECK(useless.code == 0);
    CHECK(useless.err == "-gamma: is ignored\n-normalfixup: is ignored\n"
                         "-normalize: is ignored\n");
    CHECK(
        draw(fixture, {"-help"}).out.starts_with("Render a scene by the command line of Tachyon"));
    CHECK(draw(fixture, {"-version"}).code == 0);
}

TEST_CASE("raylane tachyon's options override the scene") {
    const ToolFixture fixture;
    // A wall that the sky lights by 0.5 and one light by 0.25.
    fixture.write("wall.dat",
                  "BEGIN_SCENE RESOLUTION 1 1 SHADER_MODE FULL AMBIENT_OCCLUSION AMBIENT_COLOR "
                  "0.5 0.5 0.5 RESCALE_DIRECT 0.25 SAMPLES 4 END_SHADER_MODE DIRECTIONAL_LIGHT "
                  "DIRECTION 0 0 1 COLOR 1 1 1 PLANE CENTER 0 0 5 NORMAL 0 0 -1 TEXTURE AMBIENT 0 "
                  "DIFFUSE 1 SPECULAR 0 OPACITY 0.5 COLOR 1 1 1 TEXFUNC 0 END_SCENE");
    const auto code = [&](const std::vector<std::string>& options) {
        REQUIRE(draw(fixture, joined({"wall.dat", "-o", "out/wall.ppm"}, options)).code == 0);
        const std::string image = content_of(fixture.output() / "wall.ppm");
        return static_cast<int>(static_cast<unsigned char>(image.back()));
    };
    CHECK(code({}) == 191);
    CHECK(code({"-rescale_lights", "0.125"}) == 159);
    CHECK(code({"-add_skylight", "0.25"}) == 128);
    CHECK(code({"-add_skylight", "0.25", "-rescale_lights", "0.5"}) == 191);
    CHECK(code({"-auto_skylight", "0.75", "-rescale_lights", "0.125"}) == 255);
    CHECK(code({"-trans_vmd"}) == 96);
    CHECK(code({"-trans_max_surfaces", "0"}) == 0);
    CHECK(code({"-lowshade"}) == 255);
}

TEST_CASE("an invalid call of raylane tachyon gives an error of one line") {
    const ToolFixture fixture;
    fixture.write("a.dat", red);
    const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
        {{}, "tachyon: must be given a scene; see raylane tachyon -help"},
        {{"a.dat", "-aasample", "2"},
         "tachyon: unknown argument \"-aasample\", did you mean \"-aasamples\"?; see raylane "
         "tachyon -help"},
        {{"a.dat", "b.dat"}, "tachyon: must be given one scene, got \"b.dat\" as well"},
        {{"a.dat", "-o"}, "-o: must have a value"},
        {{"a.dat", "-res", "4"}, "-res: must have a value"},
        {{"a.dat", "-res", "4", "x"}, "-res: must be a whole number from 1 to 65535, got \"x\""},
        {{"a.dat", "-aasamples", "-1"},
         "-aasamples: must be a whole number from 0 to 2147483647, got \"-1\""},
        {{"a.dat", "-format", "PSD48"}, "-format: must be TARGA, PNG, BMP or PPM, got \"PSD48\""},
        {{"a.dat", "-auto_skylight", "2"},
         "-auto_skylight: must be a number from 0 to 1, got \"2\""},
        {{"a.dat", "-o", "a.dat"}, "-o: must be another file than SCENE, got \"a.dat\""},
        {{"none.dat"}, "none.dat: no such file"},
    };
    for (const auto& [options, message] : mistakes) {
        const Outcome outcome = draw(fixture, options);
        INFO(message);
        CHECK(outcome.code == 2);
        CHECK(outcome.err == "raylane: " + message + "\n");
    }
}
