#include "scenes/images/exr.hpp"
#include "scenes/images/reader.hpp"
#include "scenes/images/writer.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>

using namespace raylane;
using namespace raylane::tests;

namespace {

Options part(int number, int count, const Options& options = {}) {
    const std::string k = std::to_string(number), n = std::to_string(count);
    return joined({"render", "scene.json", "-o", "part-" + k + ".exr", "--part", k + "/" + n},
                  options);
}

Options merged(std::vector<int> numbers, const std::string& output) {
    Options words = {"merge"};
    for (const int number : numbers)
        words.push_back("part-" + std::to_string(number) + ".exr");
    return joined(words, {"-o", output});
}

std::string content(const ToolFixture& fixture, const std::string& name) {
    return content_of(fixture.path() / name);
}

/// Returns options for an output with the floats that parts and merged EXR have.
Options floats_in(const std::string& output) {
    return output.ends_with(".exr") ? Options{"--bits", "32"} : Options{};
}

void draw_parts(const ToolFixture& fixture, int count, const Options& options = {}) {
    for (int number = 1; number <= count; ++number)
        REQUIRE(fixture.run(part(number, count, options)).code == 0);
}

} // namespace

TEST_CASE("merged parts of an image are the same file as the whole") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    for (const Options& options :
         {Options{"--size", "150x90"},
          {"--size", "150x90", "--quality", "35"},
          {"--size", "150x90", "--quality", "35", "--crop", "21,3,100x70", "--alpha"},
          {"--size", "150x90", "--tile", "9", "--outline", "2"},
          {"--engine", "reference", "--transfer", "linear"},
          {"--size", "150x90", "--aovs"}}) {
        CAPTURE(options);
        draw_parts(fixture, 3, options);
        const bool aovs = options.back() == "--aovs";
        const std::string ending = aovs ? ".exr" : ".png";
        REQUIRE(fixture.render("whole" + ending, joined(options, floats_in(ending))).code == 0);
        const Outcome outcome = fixture.run(merged({2, 3, 1}, "merged" + ending));
        CHECK(outcome.err.empty());
        CHECK(outcome.code == 0);
        CHECK(content_of(fixture.path() / ("merged" + ending)) ==
              content_of(fixture.path() / ("whole" + ending)));
    }
    // More parts than tiles.
    draw_parts(fixture, 5);
    REQUIRE(fixture.render("whole.png").code == 0);
    CHECK(fixture.run(merged({1, 2, 3, 4, 5}, "merged.png")).code == 0);
    CHECK(content_of(fixture.path() / "merged.png") == content_of(fixture.path() / "whole.png"));
}

TEST_CASE("Merged EXR have the floats of their parts or halves on request") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    draw_parts(fixture, 2, {"--bits", "32"});
    for (const auto& [bits, expected] :
         {std::pair{Options{}, 32}, {{"--bits", "32"}, 32}, {{"--bits", "16"}, 16}}) {
        CAPTURE(bits);
        REQUIRE(fixture.run(joined(merged({1, 2}, "merged.exr"), bits)).code == 0);
        CHECK(scenes::read_image(fixture.path() / "merged.exr").bits == expected);
        const Options same = {"--bits", std::to_string(expected)};
        REQUIRE(fixture.render("whole.exr", same).code == 0);
        CHECK((content(fixture, "merged.exr") == content(fixture, "whole.exr")));
    }
}

TEST_CASE("parts that do not make a whole give an error of one line") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    const auto refusal = [&](const Options& command) {
        const Outcome outcome = fixture.run(command);
        CHECK(outcome.code == 2);
        CHECK(is_one_line(outcome.err));
        return outcome.err;
    };
    draw_parts(fixture, 3);
    CHECK(refusal(merged({1, 3}, "out/a.png")) ==
          "raylane: PARTS: must be all parts, 1 to 3; missing: 2\n");
    CHECK(refusal(merged({3}, "out/a.png")) ==
          "raylane: PARTS: must be all parts, 1 to 3; missing: 1, 2\n");
    CHECK(refusal(merged({1, 1}, "out/a.png")) == "raylane: part-1.exr: repeats part 1/3\n");
    REQUIRE(fixture.run(part(2, 4)).code == 0);
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: belongs to another division into parts than part-1.exr\n");
    REQUIRE(fixture.run(part(2, 3, {"--tile", "8"})).code == 0);
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: belongs to another division into parts than part-1.exr\n");
    REQUIRE(fixture.run(part(2, 3, {"--max-depth", "1"})).code == 0);
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: belongs to another image than part-1.exr: Comment differs\n");
    REQUIRE(fixture.render("part-2.exr").code == 0);
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: must be written by render --part\n");
    {
        scenes::ExrImage image = scenes::read_own_exr(fixture.path() / "part-1.exr");
        image.film.at(3, 4) += core::Color(1.0F);
        scenes::OutputFile(fixture.path() / "part-2.exr", scenes::more_encoders)
            .commit(image.film, {.bits = 32, .texts = image.texts});
        CHECK(refusal(merged({2, 3}, "out/a.png")) ==
              "raylane: part-2.exr: has pixels that differ from its Pixels attribute\n");
    }
    fixture.write("part-2.exr", "mine");
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: must be an EXR rendered by raylane\n");
    CHECK(refusal(merged({1, 4}, "out/a.png")) == "raylane: part-4.exr: no such file\n");
    CHECK(refusal(merged({1, 3}, "part-1.exr")).starts_with("raylane: --output: "));
    CHECK(refusal({"verify", "part-1.exr", "scene.json", "--quiet"}) ==
          "raylane: part-1.exr: must be a whole image, got a part: merge the parts first\n");
    CHECK(fixture.is_output_empty());
}

TEST_CASE("parts of scenes with different settings are refused even if the Comments are equal") {
    if (!scenes::has_exr()) return;
    const auto with = [](const std::string& settings) {
        std::string scene = ball;
        return scene.insert(scene.find("\"image\""), settings);
    };
    struct Settings {
        std::string one, other;
    };
    const std::string outlined = R"("outline": {"width": 3}, )";
    for (const Settings& settings :
         {Settings{outlined, R"("outline": {"width": 3, "color": "#ff0000"}, )"},
          {outlined, R"("outline": {"width": 3, "creases": 20}, )"},
          {"", R"("sampling": {"pattern": "stratified"}, )"}}) {
        CAPTURE(settings.other);
        const ToolFixture fixture(with(settings.one));
        draw_parts(fixture, 2);
        fixture.write("scene.json", with(settings.other));
        REQUIRE(fixture.run(part(2, 2)).code == 0);
        const Outcome outcome = fixture.run(merged({1, 2}, "out/a.png"));
        CHECK(outcome.code == 2);
        CHECK(outcome.err ==
              "raylane: part-2.exr: belongs to another image than part-1.exr: Options differs\n");
        CHECK(fixture.is_output_empty());
    }
}

TEST_CASE("parts with and without AOVs are not merged") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    draw_parts(fixture, 2);
    REQUIRE(fixture.run(part(2, 2, {"--aovs"})).code == 0);
    CHECK(fixture.run(merged({1, 2}, "out/a.exr")).err ==
          "raylane: part-2.exr: has AOVs, but part-1.exr has none\n");
    CHECK(fixture.run(merged({2, 1}, "out/a.exr")).err ==
          "raylane: part-1.exr: has no AOVs, but part-2.exr has some\n");
    CHECK(fixture.is_output_empty());
}

TEST_CASE("one frame of several can be rendered in parts") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    fixture.write("move.xyz", "2\n\nC 0 0 0\nO 0 0 1\n2\n\nC 0 0 0\nO 0 1 1\n"
                              "2\n\nC 0 0 0\nO 1 1 2\n");
    const auto ran = [&](const Options& command) {
        const Outcome outcome = fixture.run(command);
        CAPTURE(command);
        CHECK(outcome.err.empty());
        CHECK(outcome.code == 0);
    };
    const auto frame = [](const Options& options, const Options& others) {
        return joined(joined({"render", "move.xyz", "--quiet"}, options), others);
    };
    for (const Options& options :
         {Options{"--frames", "2", "--size", "150x90", "--spp", "4"},
          {"--frames", "-2", "--style", "spheres", "--zoom", "2", "--spp", "1"}, // default size
          {"--frames", "1", "--camera-from", "all", "--size", "90x90", "--spp", "1", "--view",
           "top"}}) {
        CAPTURE(options);
        std::vector<std::string> contents;
        for (const std::string k : {"1", "2", "3"}) {
            ran(frame(options, {"-o", "part-" + k + ".exr", "--part", k + "/3"}));
            contents.push_back(content(fixture, "part-" + k + ".exr"));
        }
        CHECK(contents[0] != contents[1]);
        CHECK(contents[1] != contents[2]);
        for (const std::string name : {"whole.exr", "whole.png"}) {
            ran(frame(options, joined({"-o", name}, floats_in(name))));
            ran(merged({3, 1, 2}, "merged-" + name));
            CHECK(content(fixture, "merged-" + name) == content(fixture, name));
            const Outcome verified =
                fixture.run({"verify", "merged-" + name, "move.xyz", "--quiet", "--whole"});
            CHECK(verified.err.empty());
            CHECK(verified.code == 0);
        }
        std::filesystem::remove(fixture.path() / "part-2.exr");
        CHECK(fixture.run(merged({1, 3}, "out/a.png")).err ==
              "raylane: PARTS: must be all parts, 1 to 3; missing: 2\n");
    }
    // The name has the frame's number, which is known after the file is read.
    ran({"render", "move.xyz", "--quiet", "--frames", "-1", "-o", "f%02d.exr", "--part", "1/2",
         "--spp", "1"});
    CHECK(std::filesystem::exists(fixture.path() / "f02.exr"));
    CHECK(fixture.run({"render", "move.xyz", "--frames", "1", "-o", "out/a.png", "--part", "2/3"})
              .err == "raylane: --part: goes with an output that ends in .exr\n");
    // With a range, the frames are divided and not the image.
    ran({"render", "move.xyz", "--quiet", "--frames", ":", "-o", "out/t%d.png", "--part", "2/3",
         "--spp", "1"});
    CHECK(std::filesystem::exists(fixture.output() / "t1.png"));
    CHECK(std::distance(std::filesystem::directory_iterator(fixture.output()), {}) == 1);
}

TEST_CASE("parts with alpha or AOVs are not merged into a format without them") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    const auto refused = [&](const std::string& output, const std::string& message) {
        CAPTURE(output);
        const Outcome outcome = fixture.run(merged({2, 1}, output));
        CHECK(outcome.code == 2);
        CHECK(outcome.err == "raylane: part-2.exr: was rendered " + message + "\n");
    };
    const auto becomes = [&](const std::string& output) {
        CAPTURE(output);
        const Outcome outcome = fixture.run(merged({1, 2}, output));
        CHECK(outcome.err.empty());
        CHECK(outcome.code == 0);
    };
    const Options without_alpha = {"a.pfm", "a.hdr", "a.ppm", "a.tga", "a.bmp"};
    draw_parts(fixture, 2, {"--alpha"});
    for (const std::string& output : without_alpha)
        refused("out/" + output, "without a background, which goes with PNG, TIFF or EXR");
    draw_parts(fixture, 2, {"--aovs"});
    for (const std::string& output : joined(without_alpha, {"a.png"}))
        refused("out/" + output, "with --aovs, which goes with an output that ends in .exr");
    CHECK(fixture.is_output_empty());
    becomes("a.exr");
    // If the scene itself has alpha, other formats show it over black, as render does.
    std::string with_alpha = ball;
    with_alpha.insert(with_alpha.find("\"width\""), "\"alpha\": true, ");
    fixture.write("scene.json", with_alpha);
    draw_parts(fixture, 2);
    for (const std::string output : {"b.pfm", "b.png", "b.exr"}) {
        becomes(output);
        REQUIRE(fixture.render("whole-" + output, floats_in(output)).code == 0);
        CHECK(content(fixture, output) == content(fixture, "whole-" + output));
    }
}

TEST_CASE("parts can be merged in any order and from scenes with different names") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    fixture.write("other.json", ball);
    REQUIRE(fixture.run(part(1, 2)).code == 0);
    REQUIRE(fixture.run({"render", "other.json", "-o", "part-2.exr", "--part", "2/2"}).code == 0);
    REQUIRE(fixture.render("whole.png").code == 0);
    REQUIRE(fixture.run(merged({1, 2}, "a.png")).code == 0);
    REQUIRE(fixture.run(merged({2, 1}, "b.png")).code == 0);
    CHECK(content(fixture, "a.png") == content(fixture, "whole.png"));
    CHECK(content(fixture, "b.png") == content(fixture, "whole.png"));
}

TEST_CASE("a part with a missing or malformed Rays attribute is refused") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    draw_parts(fixture, 2);
    const scenes::ExrImage image = scenes::read_own_exr(fixture.path() / "part-2.exr");
    const auto refusal = [&](const std::string& rays) {
        scenes::ImageOptions options;
        options.bits = 32;
        for (const auto& [name, text] : image.texts)
            if (name != "Rays") options.texts.emplace_back(name, text);
        if (!rays.empty()) options.texts.emplace_back("Rays", rays);
        scenes::OutputFile(fixture.path() / "part-2.exr", scenes::more_encoders)
            .commit(image.film, options);
        const Outcome outcome = fixture.run(merged({1, 2}, "out/a.png"));
        CHECK(outcome.code == 2);
        CHECK(is_one_line(outcome.err));
        return outcome.err;
    };
    CHECK(refusal("many") == "raylane: part-2.exr: has a malformed \"Rays\" attribute\n");
    CHECK(refusal("").ends_with("got one without Rays\n"));
    CHECK(fixture.is_output_empty());
}

TEST_CASE("verify renders the looks that an image names") {
    const ToolFixture fixture;
    fixture.write("a.xyz", "3\n\nO 0 0 0\nC 1.2 0 0\nH 0 1 0\n");
    const std::vector<std::string> looks = {"--show",    "all: spheres white opacity 0.4 + sticks",
                                            "--show",    "index 1: points red",
                                            "--hide",    "element H",
                                            "--color",   "green range -1:2",
                                            "--palette", "magma",
                                            "--range",   "0",
                                            "50",        "--radius",
                                            "0.3 O=0.5", "--scale",
                                            "C=1.5"};
    std::vector<std::string> render = {"render", "a.xyz", "-o", "a.png",  "--size",
                                       "60x40",  "--spp", "1",  "--quiet"};
    render.insert(render.end(), looks.begin(), looks.end());
    const Outcome drawn = fixture.run(render);
    CHECK(drawn.err.empty());
    REQUIRE(drawn.code == 0);
    const Outcome verified = fixture.run({"verify", "a.png", "a.xyz", "--quiet"});
    CHECK(verified.err.empty());
    CHECK(verified.out.starts_with("scene      same as the image names\n"));
    CHECK(verified.code == 0);
    const std::string text = content(fixture, "a.png");
    for (const char* const word : {"index 1: points red", "element H", "--palette magma", "0 50"})
        CHECK(text.find(word) != std::string::npos);
    const Outcome wrong = fixture.run({"render", "a.xyz", "-o", "b.png", "--show", "all: opacity"});
    CHECK(wrong.code == 2);
    CHECK(wrong.err == "raylane: --show: column 13: opacity must be above 0 and at most 1, got "
                       "nothing\n");
}

TEST_CASE("verify understands the selection that an image names") {
    const ToolFixture fixture;
    std::string atoms;
    double z = 0.0;
    for (const char* name : {" P  ", " C5'", " O5\"", " C\\ ", " N`1", " CA "}) {
        char line[96];
        std::snprintf(
            line, sizeof line,
            "ATOM      1 %s A   A   1       0.000   0.000%8.3f  1.00  0.00           C  \n", name,
            z);
        atoms += line;
        z += 2.0;
    }
    fixture.write("atoms.pdb", atoms + "END\n");
    const auto shown = [&](const std::string& selection) {
        CAPTURE(selection);
        const Outcome drawn = fixture.run({"render", "atoms.pdb", "-o", "a.png", "--size", "60x40",
                                           "--spp", "1", "--quiet", "--select", selection});
        CHECK(drawn.err.empty());
        REQUIRE(drawn.code == 0);
        const Outcome verified = fixture.run({"verify", "a.png", "atoms.pdb", "--quiet"});
        CHECK(verified.err.empty());
        CHECK(verified.out.starts_with("scene      same as the image names\n"));
        CHECK(verified.code == 0);
        return content(fixture, "a.png");
    };
    const std::string both = shown("name P or name C5'");
    CHECK(shown("name P\tor name C5'") == both);
    CHECK(shown("name P\tor\tname\tC5'") == both);
    CHECK(shown("name P or name CA") != both);
    for (const char* selection :
         {"name C5'", "name O5\"", "name O5\" C5'", "name C5' or name O5\"", "name N`1",
          "name C5'\tO5\" N`1", "name C\\ or name P", "name P or name C\\", "name O5\" C5' C\\",
          "not name \\\"", "not name A-B=\"", "not name A-B='", "(name P)and(name P)", "name P "})
        shown(selection);
}

TEST_CASE("a part is K/N and goes with floats in an EXR") {
    const ToolFixture fixture;
    for (const char* text : {"", "3", "0/3", "4/3", "1/0", "-1/3", "1/3/5", "a/b", "1/1e3"}) {
        const Outcome outcome = fixture.render("a.exr", {"--part", text});
        CHECK(outcome.code == 2);
        CHECK(is_one_line(outcome.err));
        CHECK(outcome.err.starts_with("raylane: --part: must be K/N, from 1/N to N/N, such as "));
    }
    CHECK(fixture.render("a.png", {"--part", "1/2"}).err ==
          "raylane: --part: goes with an output that ends in .exr\n");
    CHECK(fixture.render("a.exr", {"--part", "1/2", "--bits", "16"}).err ==
          "raylane: --part: goes with --bits 32\n");
}

TEST_CASE("the figures of a part count its pixels alone") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    for (const Options& options :
         {Options{"--size", "64x48"}, {"--size", "100x90", "--crop", "10,10,70x60", "--tile", "8"}})
        for (int number = 1; number <= 3; ++number) {
            const Outcome outcome = fixture.run(
                part(number, 3, joined({"--spp", "4", "--stats", "s.json", "-v"}, options)));
            CAPTURE(options, number, outcome.err);
            REQUIRE(outcome.code == 0);
            const auto stats = nlohmann::json::parse(content(fixture, "s.json"));
            CHECK(stats["samples_per_pixel"] == 4);
            CHECK(outcome.err.find(" pixels, 4 samples each, ") != std::string::npos);
        }
    // A part without a tile.
    REQUIRE(fixture.run(part(5, 5, {"--stats", "s.json"})).code == 0);
    CHECK(nlohmann::json::parse(content(fixture, "s.json"))["samples_per_pixel"] == 0);
}

TEST_CASE("parts can be merged and verified without their instruction set") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    std::string absent;
    draw_parts(fixture, 2, {"--precision", "robust"});
    for (const char* name : {"part-1.exr", "part-2.exr"}) {
        const scenes::ExrImage image = scenes::read_own_exr(fixture.path() / name);
        scenes::ImageOptions options{.bits = 32, .texts = image.texts};
        for (auto& [key, text] : options.texts)
            if (const std::size_t at = text.find(" --isa "); key == "Comment") {
                REQUIRE(at != std::string::npos);
                // No processor has both.
                absent = text.find("neon", at) == std::string::npos ? "neon" : "avx2";
                text.replace(at, text.find(' ', at + 7) - at, " --isa " + absent);
            }
        scenes::OutputFile(fixture.path() / name, scenes::more_encoders)
            .commit(image.film, options);
    }
    const Outcome outcome = fixture.run(merged({1, 2}, "whole.exr"));
    CHECK(outcome.err.empty());
    CHECK(outcome.code == 0);
    const Options verify = {"verify", "whole.exr", "scene.json", "--quiet"};
    const Outcome verified = fixture.run(verify);
    CHECK(verified.err.empty());
    // The hash of the options includes the instruction set that rendered the parts.
    CHECK(verified.out.find("options    differ from those that the image names\n") !=
          std::string::npos);
    CHECK(verified.out.find("192 equal, 0 within one step, 0 different\n") != std::string::npos);
    // --whole renders with the named instruction set, which is missing.
    const Outcome again = fixture.run(joined(verify, {"--whole"}));
    CHECK(again.code == 2);
    CHECK(again.err.starts_with("raylane: --isa: raylane was built without " + absent +
                                "; available: "));
}

TEST_CASE("an interrupted part resumes") {
    if (!scenes::has_exr()) return;
    const ToolFixture fixture;
    const std::filesystem::path checkpoint = fixture.path() / "part-2.exr.part";
    // A fast machine needs more samples, or the rendering ends before the signal.
    for (const char* samples : {"16", "16", "16", "64", "256", "1024", "4096"}) {
        const Options options = {"--size", "1200x1200", "--spp", samples};
        Process process = fixture.start(part(2, 2, options), on_terminal());
        static_cast<void>(process.wait_for_err(" left")); // a tile is done
        process.send(SIGTERM);
        const Outcome stopped = process.wait();
        if (!std::filesystem::exists(checkpoint)) continue;
        CHECK(stopped.code == 128 + SIGTERM);
        const Outcome resumed = fixture.run(part(2, 2, options));
        CHECK(resumed.code == 0);
        CHECK(resumed.err.find("resumes at ") != std::string::npos);
        const std::string image = content_of(fixture.path() / "part-2.exr");
        CHECK(fixture.run(part(2, 2, joined(options, {"--no-resume"}))).code == 0);
        CHECK((content_of(fixture.path() / "part-2.exr") == image));
        return;
    }
    FAIL("no signal came before the end");
}
