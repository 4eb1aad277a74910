#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <csignal>
#include <fstream>
#include <sys/stat.h>

using namespace raylane::tests;

namespace {

/// Returns the form of a text, which does not depend on the machine: N for each number and for each
/// bar of # and dots, no more than one space at a time, and rays without their prefix.
std::string form_of(const std::string& text) {
    std::string form;
    for (const char c : text) {
        const bool counted = (c >= '0' && c <= '9') || c == '.' || c == '#';
        const char shown = counted ? 'N' : c;
        const bool repeated = (counted || c == ' ') && form.ends_with(shown);
        if (!repeated) form += shown;
    }
    for (const char* prefixed : {"krays/s", "Mrays/s", "Grays/s"})
        for (std::size_t i = form.find(prefixed); i != std::string::npos; i = form.find(prefixed))
            form.erase(i, 1);
    return form;
}

/// A scene in NFF without its shapes, and the line of one shape.
const std::string nff_head = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 40\nhither 1\n"
                             "resolution 4 4\nl 9 9 9\n";
const std::string nff_line = "s 0 0 0 1\n";

} // namespace

TEST_CASE("a successful rendering prints no progress bar in a pipe") {
    const ToolFixture fixture;
    // Long enough for several drawings of a progress bar.
    const Outcome outcome =
        fixture.render("out/picture.png", {"--size", "64x64", "--spp", "1024", "--threads", "1"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(messages_in(outcome.err).empty());
    CHECK(outcome.err.find('\r') == std::string::npos);
}

TEST_CASE("a rendering shows its progress on a terminal and a summary at the end") {
    const ToolFixture fixture;
    // An existing checkpoint gets each tile at once. The first three writes are the head and two
    // tiles.
    fixture.write("out/picture.png.part", "");
    Hold hold("pwrite", 3);
    Process process = fixture.start({"render", "scene.json", "-o", "out/picture.png", "--size",
                                     "64x64", "--tile", "16", "--threads", "1"},
                                    hold.in(on_terminal()));
    REQUIRE(hold.wait());
    CHECK(process.wait_for_err(" left"));
    hold.release();
    const Outcome outcome = process.wait();
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(form_of(outcome.err).find("\r[N] N % N rays/s N s left\x1B[K") != std::string::npos);
    // The bar is wiped away before the summary.
    const std::size_t wiped = outcome.err.rfind("\r\x1B[K");
    REQUIRE(wiped != std::string::npos);
    const std::string end = form_of(outcome.err.substr(wiped + 4));
    CHECK(end == "out/pictureNpng: N x N pixels, N samples each, in N s, N rays/s\r\n");
}

TEST_CASE("reading and building show their progress on a terminal and no bar in a pipe") {
    const ToolFixture fixture;
    const std::filesystem::path pipe = fixture.path() / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    {
        // A file that does not end before its progress has been seen.
        Process process = fixture.start({"info", "pipe"}, on_terminal());
        std::ofstream file(pipe);
        file << nff_head;
        for (int i = 0; i < 200'000; ++i)
            file << nff_line;
        file.flush();
        CHECK(process.wait_for_err("\r0.2 million shapes read\x1B[K"));
        file.close();
        const Outcome shown = process.wait();
        CHECK(shown.code == 0);
        CHECK(shown.err.ends_with("\r\x1B[K"));
    }
    fixture.write("scene.json",
                  R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
            "lights": [{"type": "directional", "direction": [-1, -2, -3]}],
            "objects": [{"type": "sphereflake", "material": {}, "center": [0, 0, 0], "radius": 1,
                         "depth": 6}]})");
    {
        // When all shapes are placed, the process returns the first of its large arrays.
        Hold hold("madvise", 3);
        Setup setup = hold.in(on_terminal());
        setup.in_child = [prepare = setup.in_child] {
            prepare();
            ::setenv("RAYLANE_THREADS", "1", 1);
        };
        Process process = fixture.start({"info", "scene.json"}, setup);
        REQUIRE(hold.wait());
        CHECK(process.wait_for_err(" million shapes placed\x1B[K"));
        hold.release();
        const Outcome shown = process.wait();
        CHECK(shown.code == 0);
        CHECK(form_of(shown.err).find("\r[N] N % of N million shapes placed\x1B[K") !=
              std::string::npos);
    }
    CHECK(messages_in(fixture.run({"info", "scene.json"}).err).empty());
}

TEST_CASE("reading a file shows how much of it has been read") {
    const ToolFixture fixture;
    std::string text = nff_head;
    while (text.size() < 16 << 20)
        text += nff_line;
    fixture.write("scene.nff", text);
    // A read takes no more than a mebibyte.
    Hold hold("read", 8);
    Process process = fixture.start({"info", "scene.nff"}, hold.in(on_terminal()));
    REQUIRE(hold.wait());
    CHECK(process.wait_for_err(" % "));
    hold.release();
    const Outcome outcome = process.wait();
    CHECK(outcome.code == 0);
    CHECK(form_of(outcome.err).find("\r[N] N % N million shapes read\x1B[K") != std::string::npos);
}

TEST_CASE("an error is one line on a terminal") {
    const ToolFixture fixture;
    CHECK(fixture.run({"render", "none.json"}, on_terminal()).err ==
          "raylane: none.json: no such file\r\n");
    std::filesystem::create_symlink("/dev/full", fixture.path() / "full.png");
    const Outcome outcome = fixture.run({"render", "scene.json", "-o", "full.png"}, on_terminal());
    CHECK(outcome.code == 3);
    CHECK(outcome.err.ends_with("raylane: full.png: cannot write: No space left on device\r\n"));
    CHECK(is_one_line(outcome.err));
}

TEST_CASE("the prompt begins a new line after an interruption") {
    const ToolFixture fixture;
    Process process = fixture.start(
        joined({"render", "scene.json", "-o", "out/picture.png"}, hours), on_terminal());
    REQUIRE(fixture.wait_for_files(process, 1));
    REQUIRE(process.wait_for_err("\r")); // the line is not empty
    process.send(SIGHUP);
    const Outcome outcome = process.wait();
    CAPTURE(outcome.err);
    CHECK(outcome.code == 128 + SIGHUP);
    CHECK(outcome.err.ends_with("\r\n"));
    CHECK(fixture.is_output_empty());
}
