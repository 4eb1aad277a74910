#include "scenes/image/exr.hpp"
#include "scenes/image/writer.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/tool/workshop.hpp"

#include <csignal>

using namespace raylane;
using namespace raylane::tests;

namespace {

using Options = std::vector<std::string>;

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

void draw_parts(const Workshop& workshop, int count, const Options& options = {}) {
    for (int number = 1; number <= count; ++number)
        REQUIRE(workshop.run(part(number, count, options)).code == 0);
}

} // namespace

TEST_CASE("parts of a picture, put together, are the same file as the whole") {
    if (!scenes::has_exr()) return;
    const Workshop workshop;
    for (const Options& options :
         {Options{"--size", "150x90"},
          {"--size", "150x90", "--quality", "35"},
          {"--size", "150x90", "--quality", "35", "--crop", "21,3,100x70", "--alpha"},
          {"--size", "150x90", "--tile", "9", "--outline", "2"},
          {"--engine", "reference", "--transfer", "linear"},
          {"--size", "150x90", "--layers"}}) {
        CAPTURE(options);
        draw_parts(workshop, 3, options);
        const bool layers = options.back() == "--layers";
        const std::string ending = layers ? ".exr" : ".png";
        REQUIRE(workshop.render("whole" + ending, options).code == 0);
        const Outcome outcome = workshop.run(merged({2, 3, 1}, "merged" + ending));
        CHECK(outcome.err.empty());
        CHECK(outcome.code == 0);
        CHECK(content_of(workshop.path() / ("merged" + ending)) ==
              content_of(workshop.path() / ("whole" + ending)));
    }
    // More parts than tiles.
    draw_parts(workshop, 5);
    REQUIRE(workshop.render("whole.png").code == 0);
    CHECK(workshop.run(merged({1, 2, 3, 4, 5}, "merged.png")).code == 0);
    CHECK(content_of(workshop.path() / "merged.png") == content_of(workshop.path() / "whole.png"));
}

TEST_CASE("parts that make no whole are refused in one line") {
    if (!scenes::has_exr()) return;
    const Workshop workshop;
    const auto refusal = [&](const Options& command) {
        const Outcome outcome = workshop.run(command);
        CHECK(outcome.code == 2);
        CHECK(is_one_line(outcome.err));
        return outcome.err;
    };
    draw_parts(workshop, 3);
    CHECK(refusal(merged({1, 3}, "out/a.png")) ==
          "raylane: PARTS: must be all 3, but there is no part 2\n");
    CHECK(refusal(merged({3}, "out/a.png")) ==
          "raylane: PARTS: must be all 3, but there is no part 1, 2\n");
    CHECK(refusal(merged({1, 1}, "out/a.png")) == "raylane: part-1.exr: is part 1/3 once more\n");
    REQUIRE(workshop.run(part(2, 4)).code == 0);
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: is a part of another division than part-1.exr\n");
    REQUIRE(workshop.run(part(2, 3, {"--tile", "8"})).code == 0);
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: is a part of another division than part-1.exr\n");
    REQUIRE(workshop.run(part(2, 3, {"--max-depth", "1"})).code == 0);
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: is of another picture than part-1.exr: its Comment differs\n");
    REQUIRE(workshop.render("part-2.exr").code == 0);
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: must be what render --part has drawn\n");
    {
        scenes::ExrPicture picture = scenes::read_own_exr(workshop.path() / "part-1.exr");
        picture.film.at(3, 4) += core::Color(1.0F);
        scenes::PictureOptions options;
        options.bits = 32;
        options.texts = picture.texts;
        scenes::OutputFile(workshop.path() / "part-2.exr", scenes::exr_of)
            .commit(picture.film, options);
        CHECK(refusal(merged({2, 3}, "out/a.png")) ==
              "raylane: part-2.exr: has other pixels than it says that it was drawn with\n");
    }
    workshop.write("part-2.exr", "mine");
    CHECK(refusal(merged({1, 2, 3}, "out/a.png")) ==
          "raylane: part-2.exr: must be an EXR that raylane has drawn\n");
    CHECK(refusal(merged({1, 4}, "out/a.png")) == "raylane: part-4.exr: no such file\n");
    CHECK(refusal(merged({1, 3}, "part-1.exr")).starts_with("raylane: --output: "));
    CHECK(refusal({"verify", "part-1.exr", "scene.json", "--quiet"}) ==
          "raylane: part-1.exr: is a part of a picture, to be merged first\n");
    CHECK(workshop.is_output_empty());
}

TEST_CASE("a part is K/N, and has floats in an EXR") {
    const Workshop workshop;
    for (const char* text : {"", "3", "0/3", "4/3", "1/0", "-1/3", "1/3/5", "a/b", "1/1e3"}) {
        const Outcome outcome = workshop.render("a.exr", {"--part", text});
        CHECK(outcome.code == 2);
        CHECK(is_one_line(outcome.err));
        CHECK(outcome.err.starts_with("raylane: --part: must be K/N, from 1/N to N/N, such as "));
    }
    CHECK(workshop.render("a.png", {"--part", "1/2"}).err ==
          "raylane: --part: goes with an output that ends in .exr\n");
    CHECK(workshop.render("a.exr", {"--part", "1/2", "--bits", "16"}).err ==
          "raylane: --part: goes with --bits 32\n");
}

TEST_CASE("a part that was interrupted goes on, too") {
    if (!scenes::has_exr()) return;
    const Workshop workshop;
    const Options options = {"--size", "1200x1200", "--spp", "16"};
    draw_parts(workshop, 2, options);
    const std::string expected = content_of(workshop.path() / "part-2.exr");
    Process process = workshop.start(part(2, 2, options));
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    process.send(SIGTERM);
    const Outcome stopped = process.wait();
    if (stopped.code == 0) return; // a fast machine
    CHECK(stopped.code == 128 + SIGTERM);
    CHECK(workshop.run(part(2, 2, options)).code == 0);
    CHECK(content_of(workshop.path() / "part-2.exr") == expected);
}
