#include "tests/catch.hpp"
#include "tests/scenes/tool/workshop.hpp"

#include <csignal>
#include <regex>
#include <thread>

using namespace raylane::tests;

namespace {

Setup on_terminal() {
    Setup setup;
    setup.terminal = true;
    return setup;
}

} // namespace

TEST_CASE("a good rendering says nothing in a pipe") {
    const Workshop workshop;
    // Long enough for several drawings of a progress bar.
    const Outcome outcome =
        workshop.render("out/picture.png", {"--size", "64x64", "--spp", "1024", "--threads", "1"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
}

TEST_CASE("a rendering shows its progress on a terminal, and at the end a summary") {
    const Workshop workshop;
    // The ball fills a tile every so often; on a fast machine it takes more samples to be seen.
    Outcome outcome{};
    for (const char* samples : {"1024", "4096", "16384"}) {
        outcome = workshop.run({"render", "scene.json", "-o", "out/picture.png", "--size", "64x64",
                                "--threads", "1", "--spp", samples},
                               on_terminal());
        REQUIRE(outcome.code == 0);
        if (outcome.err.find("left") != std::string::npos) break;
    }
    CHECK(outcome.out.empty());
    const std::regex bar(
        R"(\r\[#*\.+\] +\d\d? %  \d+(\.\d+)? [kMG]?rays/s  \d+\.\d s left\x1B\[K)");
    CHECK(std::regex_search(outcome.err, bar));
    // The bar is wiped away before the summary.
    const std::size_t wiped = outcome.err.rfind("\r\x1B[K");
    REQUIRE(wiped != std::string::npos);
    const std::regex summary(
        R"(out/picture\.png: 64 x 64 pixels, \d+ samples each, in \d+\.\d s, \d+\.\d+ [kMG]rays/s\r\n)");
    const std::string end = outcome.err.substr(wiped + 4);
    CAPTURE(end);
    CHECK(std::regex_match(end, summary));
}

TEST_CASE("an error is one line on a terminal, too") {
    const Workshop workshop;
    CHECK(workshop.run({"render", "none.json"}, on_terminal()).err ==
          "raylane: none.json: no such file\r\n");
    std::filesystem::create_symlink("/dev/full", workshop.path() / "full.png");
    const Outcome outcome = workshop.run({"render", "scene.json", "-o", "full.png"}, on_terminal());
    CHECK(outcome.code == 3);
    CHECK(outcome.err.ends_with("raylane: full.png: cannot write: No space left on device\r\n"));
    CHECK(is_one_line(outcome.err));
}

TEST_CASE("the prompt stands on a line of its own after an interruption") {
    const Workshop workshop;
    Process process = workshop.start(
        joined({"render", "scene.json", "-o", "out/picture.png"}, hours), on_terminal());
    while (workshop.is_output_empty())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    process.send(SIGINT);
    const Outcome outcome = process.wait();
    CAPTURE(outcome.err);
    CHECK(outcome.code == 128 + SIGINT);
    CHECK(outcome.err.ends_with("\r\n"));
    CHECK(workshop.is_output_empty());
}
