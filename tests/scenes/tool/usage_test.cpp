#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

using namespace raylane::tests;

namespace {

using Arguments = std::vector<std::string>;

/// Checks that a usage error gives one line and writes no file.
void check(const ToolFixture& fixture, const Arguments& arguments, const std::string& message) {
    for (const std::string& argument : arguments)
        UNSCOPED_INFO(argument);
    const std::ptrdiff_t files = std::ssize(fixture.names());
    const Outcome outcome = fixture.run(arguments);
    CHECK(outcome.code == 2);
    CHECK(outcome.exited);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == "raylane: " + message + "\n");
    CHECK(is_one_line(outcome.err));
    CHECK(fixture.is_output_empty());
    CHECK(std::ssize(fixture.names()) == files);
}

} // namespace

TEST_CASE("an invalid command line gives an error of one line") {
    const ToolFixture fixture;
    const std::string see = "; see raylane --help", see_render = "; see raylane render --help";
    const std::vector<std::pair<Arguments, std::string>> rows = {
        {{},
         "must be given a command: render, info, compare, convert, build, tachyon, trace, merge, "
         "verify, view, help, manual or "
         "completion" +
             see},
        {{"rendr", "scene.json"}, R"(unknown argument "rendr", did you mean "render"?)" + see},
        {{"draw"}, R"(unknown argument "draw")" + see},
        {{""}, R"(unknown argument "")" + see},
        {{"--versoin"}, R"(unknown argument "--versoin", did you mean "--version"?)" + see},
        {{"-x"}, R"(unknown argument "-x")" + see},
        {{"render"}, "SCENE: must be given" + see_render},
        {{"info", "--json"}, "SCENE: must be given; see raylane info --help"},
        {{"compare", "a.png"}, "B: must be given; see raylane compare --help"},
        {{"render", "scene.json", "--sise", "8x8"},
         R"(unknown argument "--sise", did you mean "--size"?)" + see_render},
        {{"render", "scene.json", "--sise=8x8"},
         R"(unknown argument "--sise=8x8", did you mean "--size"?)" + see_render},
        {{"render", "scene.json", "--json"}, R"(unknown argument "--json")" + see_render},
        {{"render", "scene.json", "-y"}, R"(unknown argument "-y")" + see_render},
        {{"render", "scene.json", "b.json"},
         R"(unknown argument "b.json"; values with spaces need quotes)" + see_render},
        {{"render", "scene.json", "--show", "protein:", "cartoon"},
         R"(unknown argument "cartoon"; values with spaces need quotes)" + see_render},
        {{"render", "scene.json", "a\nb\x1B[31m\xFF"},
         R"(unknown argument "a\x0Ab\x1B[31m\xFF"; values with spaces need quotes)" + see_render},
        {{"info", "scene.json", "render", "scene.json"},
         R"(unknown argument "render"; values with spaces need quotes; see raylane info --help)"},
        {{"--size", "8x8", "render", "scene.json"},
         R"(--size: must come after "render")" + see_render},
        {{"--sise", "render", "scene.json"}, R"(unknown argument "--sise")" + see_render},
        {{"render", "scene.json", "-o"}, "--output: must have a value, FILE" + see_render},
        {{"render", "scene.json", "--size"}, "--size: must have a value, WxH" + see_render},
        {{"render", "scene.json", "-o", "out/a.png", "--output", "out/b.png"},
         "--output: must be given only once" + see_render},
        {{"info", "scene.json", "--json=maybe"},
         "--json: must have no value; see raylane info --help"},
    };
    for (const auto& [arguments, message] : rows)
        check(fixture, arguments, message);
}

TEST_CASE("an invalid value of an option gives an error of one line") {
    const ToolFixture fixture;
    const std::string size = "--size: must be WIDTHxHEIGHT in pixels, each from 1 to 65535, such "
                             "as 640x480, got ",
                      spp = "--spp: must be a square number from 1 to 65536, such as 1, 4, 9 or "
                            "16, got ",
                      depth = "--max-depth: must be a whole number from 0 to 1000, got ",
                      weight = "--min-weight: must be a number from 0 to 1, got ",
                      threads = "--threads: must be a whole number from 1 to 4096, got ";
    const std::vector<std::pair<Arguments, std::string>> rows = {
        {{"--size", "0x5"}, size + "\"0x5\""},
        {{"--size", "5x0"}, size + "\"5x0\""},
        {{"--size", "abc"}, size + "\"abc\""},
        {{"--size", "5"}, size + "\"5\""},
        {{"--size", "5x5x5"}, size + "\"5x5x5\""},
        {{"--size", "-5x5"}, size + "\"-5x5\""},
        {{"--size", "5x 5"}, size + "\"5x 5\""},
        {{"--size", ""}, size + "\"\""},
        {{"--size", "65536x1"}, size + "\"65536x1\""},
        {{"--size", "99999999999x1"}, size + "\"99999999999x1\""},
        {{"--size", "65535x65535"},
         "--size: must be at most 268435456 pixels in all, got \"65535x65535\""},
        {{"--size", "16385x16384"},
         "--size: must be at most 268435456 pixels in all, got \"16385x16384\""},
        {{"--spp", "5"}, spp + "\"5\""},
        {{"--spp", "0"}, spp + "\"0\""},
        {{"--spp", "-4"}, spp + "\"-4\""},
        {{"--spp", "66049"}, spp + "\"66049\""},
        {{"--spp", "4.0"}, spp + "\"4.0\""},
        {{"--filter", "tent"}, "--filter: must be box, gaussian or blackman-harris, got \"tent\""},
        {{"--light-samples", "-2"},
         "--light-samples: must be a whole number from -1 to 4096, got \"-2\""},
        {{"--draft", "--spp", "4"}, "--draft: goes without --spp"},
        {{"--draft", "--light-samples", "4"}, "--draft: goes without --light-samples"},
        {{"--draft", "--quality", "40"}, "--draft: goes without --quality"},
        {{"--draft", "--print"}, "--draft: goes without --print"},
        {{"--print", "--spp", "4"}, "--print: goes without --spp"},
        {{"--quality", "5"}, "--quality: must be a number from 10 to 80, got \"5\""},
        {{"--quality", "best"}, "--quality: must be a number from 10 to 80, got \"best\""},
        {{"--quality", "40", "--spp", "4"}, "--quality: goes without --spp"},
        {{"--max-depth", "-1"}, depth + "\"-1\""},
        {{"--max-depth", "1001"}, depth + "\"1001\""},
        {{"--min-weight", "2"}, weight + "\"2\""},
        {{"--min-weight", "-0.5"}, weight + "\"-0.5\""},
        {{"--min-weight", "nan"}, weight + "\"nan\""},
        {{"--threads", "0"}, threads + "\"0\""},
        {{"--threads", "4097"}, threads + "\"4097\""},
        {{"--threads", "many"}, threads + "\"many\""},
        {{"--engine", "foo"}, "--engine: must be vector or reference, got \"foo\""},
        {{"--precision", "half"},
         "--precision: must be fast, robust, exact or double, got \"half\""},
        {{"--isa", "avx1"},
         "--isa: must be portable, sse4.2, avx2, avx512 or neon, got \"avx1\", did you mean "
         "\"avx2\"?"},
        {{"--isa", "avx2", "--engine", "reference"}, "--isa: goes with --engine vector"},
        {{"--tile", "7"}, "--tile: must be a whole number from 8 to 64, got \"7\""},
        {{"--tile", "65"}, "--tile: must be a whole number from 8 to 64, got \"65\""},
        {{"--transfer", "x"}, "--transfer: must be srgb or linear, got \"x\""},
        {{"--transfer", "srbg"},
         "--transfer: must be srgb or linear, got \"srbg\", did you mean \"srgb\"?"},
    };
    for (const auto& [option, message] : rows) {
        check(fixture, joined({"render", "scene.json", "-o", "out/picture.png"}, option), message);
        // The error comes before the scene is read.
        check(fixture, joined({"render", "none.json", "-o", "out/picture.png"}, option), message);
    }
    check(fixture, {"compare", "none.png", "none.png", "--tolerance", "-1"},
          "--tolerance: must be a number from 0 to 3.4028235e+38, got \"-1\"");
}

TEST_CASE("an invalid file name gives an error of one line before any file is read") {
    const ToolFixture fixture;
    std::filesystem::create_symlink("scene.json", fixture.path() / "scene.png");
    fixture.write("stats.png", "");
    fixture.write("image.png", std::string("\x89PNG\r\n\x1A\n\0", 9));
    std::filesystem::create_hard_link(fixture.path() / "stats.png", fixture.path() / "stats.link");
    const std::vector<std::pair<Arguments, std::string>> rows = {
        {{"render", ""}, R"(SCENE: must be the name of a file, got "")"},
        {{"info", ""}, R"(SCENE: must be the name of a file, got "")"},
        {{"render", "none.json", "-o", ""}, R"(--output: must be the name of a file, got "")"},
        {{"render", "none.json", "--stats", ""}, R"(--stats: must be the name of a file, got "")"},
        {{"compare", "", "none.png"}, R"(A: must be the name of a file, got "")"},
        {{"compare", "none.png", ""}, R"(B: must be the name of a file, got "")"},
        {{"compare", "none.png", "none.png", "--diff", ""},
         R"(--diff: must be the name of a file, got "")"},
        {{"render", "none.json", "-o", "out/picture.jpg"},
         R"(out/picture.jpg: must end in .png, .tif, .tiff, .exr, .hdr, .pfm, .tga, .bmp or .ppm, got ".jpg")"},
        {{"render", "none.json", "-o", "out/picture"},
         "out/picture: must end in .png, .tif, .tiff, .exr, .hdr, .pfm, .tga, .bmp or .ppm, got no "
         "ending"},
        {{"compare", "none.png", "none.png", "--diff", "out/difference.gif"},
         R"(out/difference.gif: must end in .png, .tif, .tiff, .exr, .hdr, .pfm, .tga, .bmp or .ppm, got ".gif")"},
        // Files that would be overwritten.
        {{"render", "none.json", "-o", "out/a.png", "--stats", "./out/a.png"},
         R"(--stats: must be another file than --output, got "./out/a.png")"},
        {{"render", "none.json", "-o", "stats.png", "--stats", "stats.link"},
         R"(--stats: must be another file than --output, got "stats.link")"},
        {{"render", "scene.json", "-o", "out/a.png", "--stats", "out/../scene.json"},
         R"(--stats: must be another file than SCENE, got "out/../scene.json")"},
        {{"render", "scene.json", "-o", "scene.png"},
         R"(--output: must be another file than SCENE, got "scene.png")"},
        {{"render", "image.png"},
         "image.png: must be a scene or atoms in a text format, got a binary file"},
        {{"render", "scene.json"}, R"(--output: must be another file than SCENE, got "scene.png")"},
        {{"compare", "a.png", "b.png", "--diff", "a.png"},
         R"(--diff: must be another file than A, got "a.png")"},
        {{"compare", "a.png", "b.png", "--diff", "./b.png"},
         R"(--diff: must be another file than B, got "./b.png")"},
        // Outputs that would share a stream.
        {{"render", "none.json", "-o", "-", "--stats", "-"},
         R"(--stats: must be another file than --output, got "-")"},
        {{"render", "-", "-o", "-", "--stats", "-"},
         R"(--stats: must be another file than --output, got "-")"},
        {{"compare", "a.png", "b.png", "--diff", "-"},
         R"(--diff: must be another file than standard output, which receives the result, got "-")"},
        {{"compare", "-", "b.png", "--json", "--diff", "-"},
         R"(--diff: must be another file than standard output, which receives the result, got "-")"},
    };
    for (const auto& [arguments, message] : rows)
        check(fixture, arguments, message);
    CHECK(content_of(fixture.path() / "scene.json") == ball);
}

TEST_CASE("a scene's name without a stem is refused as a directory") {
    const ToolFixture fixture;
    check(fixture, {"render", "out/"}, "out/: must be a file, got a directory");
    check(fixture, {"render", ".."}, "..: must be a file, got a directory");
    check(fixture, {"render", "/"}, "/: must be a file, got a directory");
}

TEST_CASE("the help has an example and the version is one line") {
    const ToolFixture fixture;
    const std::vector<std::pair<Arguments, std::string>> rows = {
        {{"--help"}, "\nExample: raylane render "},
        {{"-h"}, "\nExample: raylane render "},
        {{"render", "--help"}, "\nExample: raylane render "},
        {{"info", "--help"}, "\nExample: raylane info "},
        {{"compare", "--help"}, "\nExample: raylane compare "},
    };
    for (const auto& [arguments, example] : rows) {
        const Outcome outcome = fixture.run(arguments);
        CHECK(outcome.code == 0);
        CHECK(outcome.err.empty());
        CHECK(outcome.out.find(example) != std::string::npos);
    }
    const Outcome version = fixture.run({"--version"});
    CHECK(version.code == 0);
    CHECK(version.out == "raylane " RAYLANE_VERSION "\n");
    CHECK(version.err.empty());
}
