#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

/// Tests of scenes that are built once for many images.
using namespace raylane::tests;

namespace {

const std::string atoms = "4\n\nO 0 0 0\nH 1 0 0\nH 0 1 0\nC 3 0.5 1\n";

void check_same_file(const ToolFixture& fixture, const std::string& a, const std::string& b) {
    CHECK(content_of(fixture.path() / a) == content_of(fixture.path() / b));
}

} // namespace

TEST_CASE("a built scene renders the same image as its source") {
    const ToolFixture fixture;
    fixture.write("a.xyz", atoms);
    const std::vector<std::string> size = {"--size", "40x30", "-q"};
    REQUIRE(fixture.run({"build", "a.xyz", "-o", "a.rl", "--style", "spheres"}).code == 0);
    CHECK(fixture.run(joined({"render", "a.xyz", "-o", "out/a.pfm", "--style", "spheres"}, size))
              .code == 0);
    CHECK(fixture.run(joined({"render", "a.rl", "-o", "out/b.pfm"}, size)).code == 0);
    check_same_file(fixture, "out/a.pfm", "out/b.pfm");
    // With --view, the camera moves, and the fog with it.
    const std::vector<std::string> above = {"--view", "top"};
    CHECK(
        fixture
            .run(joined(joined({"render", "a.xyz", "-o", "out/a.pfm", "--style", "spheres"}, size),
                        above))
            .code == 0);
    CHECK(fixture.run(joined(joined({"render", "a.rl", "-o", "out/b.pfm"}, size), above)).code ==
          0);
    check_same_file(fixture, "out/a.pfm", "out/b.pfm");
}

TEST_CASE("build names its output after the scene by default and reports it") {
    const ToolFixture fixture;
    const Outcome outcome = fixture.run({"build", "scene.json", "-v"});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("scene.rl: 1 shapes, ") != std::string::npos);
    CHECK(fixture.run({"info", "scene.rl"}).code == 0);
    CHECK(fixture.run({"convert", "scene.rl", "again.json", "-q"}).code == 0);
    CHECK(fixture.run({"convert", "scene.json", "once.json", "-q"}).code == 0);
    check_same_file(fixture, "again.json", "once.json");
    CHECK(fixture.run({"build", "scene.rl", "-o", "other.rl", "-q"}).code == 0);
    check_same_file(fixture, "scene.rl", "other.rl");
}

TEST_CASE("a built scene that is truncated while it is in use ends the command with one line") {
    const ToolFixture fixture;
    REQUIRE(fixture.run({"build", "scene.json", "-o", "a.rl", "-q"}).code == 0);
    Process process = fixture.start(
        joined({"render", "a.rl", "-o", "out/picture.png", "--verbose", "--threads", "1"}, hours));
    REQUIRE(process.wait_for_err("rays/s")); // the rendering has begun
    std::filesystem::resize_file(fixture.path() / "a.rl", 0);
    const Outcome outcome = process.wait();
    CHECK(outcome.code == 3);
    CHECK(outcome.exited);
    CHECK(last_line(outcome.err) ==
          "raylane: a built scene was truncated while in use, or can no longer be read");
    CHECK(count_of("raylane: ", outcome.err) == 1);
    CHECK(!std::filesystem::exists(fixture.output() / "picture.png"));
}

TEST_CASE("scenes that cannot be built and invalid built scenes give an error of one line") {
    const ToolFixture fixture;
    fixture.write("bad.rl", "not built");
    fixture.write("solid.json", R"({"camera": {"from": [0, 0, 5], "at": [0, 0, 0]},
        "lights": [{"type": "directional", "direction": [-1, -2, -3]}], "materials": {"m": {}},
        "objects": [{"type": "intersection", "material": "m", "objects": [
            {"type": "sphere", "center": [0, 0, 0], "radius": 1},
            {"type": "plane", "point": [0, 0, 0], "normal": [1, 0, 0]}]}]})");
    const auto says = [&](const std::vector<std::string>& arguments, const std::string& text) {
        const Outcome outcome = fixture.run(arguments);
        CAPTURE(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(is_one_line(outcome.err));
        CHECK(outcome.err.find(text) != std::string::npos);
    };
    says({"build", "scene.json", "-o", "out/a.json"}, "--output: must end in .rl");
    says({"build", "scene.json", "-o", "scene.json"}, "--output: ");
    says({"build", "solid.json", "-o", "out/a.rl"}, "out/a.rl: cannot store constructed solids");
    says({"render", "bad.rl", "-o", "out/a.png"}, "bad.rl: must be ");
    fixture.run({"build", "scene.json", "-q"});
    says({"render", "scene.rl", "-o", "out/a.png", "--style", "spheres"},
         "goes with a file of atoms");
    says({"render", "scene.rl", "-o", "out/a.png", "--set", "a=1"},
         "only JSON scenes have parameters");
    CHECK(fixture.is_output_empty());
}
