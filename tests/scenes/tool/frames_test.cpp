#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

#include <csignal>

using namespace raylane;
using namespace raylane::tests;

namespace {

/// Returns three atoms that move apart, frame by frame.
std::string trajectory(int frames) {
    std::string text;
    for (int i = 0; i < frames; ++i) {
        const std::string at = std::to_string(1 + i);
        text += "3\n\nO 0 0 0\nH " + at + " 0 0\nH 0 " + at + " 0\n";
    }
    return text;
}

/// A ball whose radius is a parameter, with an automatic camera.
const std::string growing = R"({
    "image": {"width": 16, "height": 12},
    "camera": "auto",
    "parameters": {"r": 1, "x": 0},
    "materials": {"red": {"color": [1, 0, 0]}},
    "objects": [{"type": "sphere", "material": "red", "center": ["$x", 0, 0], "radius": "$r"}]
})";

std::string image(const ToolFixture& fixture, const std::string& name) {
    return content_of(fixture.path() / name);
}

std::string complaint(const ToolFixture& fixture, const Options& options) {
    const Outcome outcome = fixture.run(joined({"render"}, options));
    CHECK(outcome.code == 2);
    CHECK(is_one_line(outcome.err));
    return outcome.err;
}

const Options small = {"--size", "16x12", "--spp", "1"};

} // namespace

TEST_CASE("the frames of a range are rendered with their numbers") {
    const ToolFixture fixture;
    fixture.write("move.xyz", trajectory(7));
    const auto drawn = [&](const std::string& frames) {
        std::filesystem::remove_all(fixture.output());
        std::filesystem::create_directory(fixture.output());
        const Outcome outcome = fixture.run(
            joined({"render", "move.xyz", "-o", "out/f%02d.pfm", "--frames", frames}, small));
        CHECK(outcome.code == 0);
        CHECK(outcome.err.empty());
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(fixture.output()))
            names.push_back(entry.path().stem().string());
        std::sort(names.begin(), names.end());
        return names;
    };
    CHECK(drawn("1:6:2") == Options{"f01", "f03", "f05"});
    CHECK(drawn("-2:") == Options{"f05", "f06"});
    CHECK(drawn(":-5") == Options{"f00", "f01"});
    CHECK(drawn("5:100") == Options{"f05", "f06"});
    CHECK(drawn("::3") == Options{"f00", "f03", "f06"});
    CHECK(drawn("3:4") == Options{"f03"});
    CHECK(drawn("3") == Options{"f03"});
    // With a camera for each frame, a frame has the bits of its separate image.
    const Options each = joined(small, {"--camera-from", "each"});
    CHECK(fixture.run(joined({"render", "move.xyz", "-o", "out/e%d.pfm", "--frames", "2:4"}, each))
              .code == 0);
    CHECK(fixture.run(joined({"render", "move.xyz", "-o", "out/alone.pfm", "--frames", "-4"}, each))
              .code == 0);
    CHECK(image(fixture, "out/e3.pfm") == image(fixture, "out/alone.pfm"));
}

TEST_CASE("a camera fits the first frame or all frames or each frame") {
    const ToolFixture fixture;
    fixture.write("move.xyz", trajectory(3));
    const auto draw = [&](const std::string& fit) {
        CHECK(fixture
                  .run(joined({"render", "move.xyz", "-o", fit + "%d.pfm", "--frames", ":",
                               "--camera-from", fit},
                              small))
                  .code == 0);
        return Options{image(fixture, fit + "0.pfm"), image(fixture, fit + "2.pfm")};
    };
    const Options first = draw("first"), all = draw("all"), each = draw("each");
    CHECK(first[0] == each[0]);
    CHECK(first[1] != each[1]);
    CHECK(all[0] != each[0]);
    CHECK(all[1] != first[1]);
}

TEST_CASE("parameters can be swept alone and together") {
    const ToolFixture fixture(growing);
    const auto render = [&](const std::string& name, const Options& options) {
        const Outcome outcome = fixture.render(name, options);
        CHECK(outcome.err.empty());
        CHECK(outcome.code == 0);
    };
    render("s%d.pfm", {"--set", "r=1:2:3", "--set", "x=0:0.5:3", "--camera-from", "each"});
    CHECK(!std::filesystem::exists(fixture.path() / "s3.pfm"));
    render("one.pfm", {"--set", "r=1.5", "--set", "x=0.25"});
    CHECK(image(fixture, "s1.pfm") == image(fixture, "one.pfm"));
    render("last.pfm", {"--set=r=2", "--set=x=0.5"});
    CHECK(image(fixture, "s2.pfm") == image(fixture, "last.pfm"));
    // The camera of the first image shows that the ball grows.
    render("g%d.pfm", {"--set", "r=1:2:2"});
    CHECK(image(fixture, "g0.pfm") != image(fixture, "g1.pfm"));
    // Other commands accept --set, too.
    const Outcome converted = fixture.run({"convert", "scene.json", "-", "--set", "r=3"});
    CHECK(nlohmann::json::parse(converted.out)["objects"][0]["radius"] == 3);
}

TEST_CASE("a sweep of one value makes a numbered image") {
    const ToolFixture fixture(growing);
    for (const Options& sweep : {Options{"--set", "r=2:3:1"}, {"--set", "r=2", "--turn", "9/1"}}) {
        std::filesystem::remove(fixture.path() / "f0.png");
        CHECK(fixture.render("f%d.png", sweep).code == 0);
        CHECK(!std::filesystem::exists(fixture.path() / "f%d.png"));
        CHECK(image(fixture, "f0.png").size() > 0);
        const Outcome verified = fixture.run({"verify", "f0.png", "scene.json", "--quiet"});
        CHECK(verified.err.empty());
        CHECK(verified.code == 0);
    }
    CHECK(fixture.render("s%d.pfm", {"--set", "r=2:3:1"}).code == 0);
    CHECK(fixture.render("one.pfm", {"--set", "r=2"}).code == 0);
    CHECK(image(fixture, "s0.pfm") == image(fixture, "one.pfm"));
    CHECK(complaint(fixture, {"scene.json", "-o", "f.png", "--set", "r=2:3:1"})
              .find("--output: must have one placeholder") != std::string::npos);
}

TEST_CASE("whole numbers stay whole in a sweep") {
    const ToolFixture fixture(R"({"image": {"width": "$w", "height": 1}, "camera": "auto",
        "objects": [{"type": "sphere", "material": {}, "center": [0, 0, 0], "radius": 1}]})");
    const Outcome outcome = fixture.render("w%d.pfm", {"--set", "w=1:23:23"});
    CHECK(outcome.err.empty());
    CHECK(outcome.code == 0);
    CHECK(std::filesystem::exists(fixture.path() / "w22.pfm"));
}

TEST_CASE("each image of a sweep has the fog of its scene for any camera") {
    std::string foggy = growing;
    foggy.insert(1, R"("fog": {"type": "exponential", "density": "$d"},)");
    const ToolFixture fixture(foggy);
    CHECK(fixture.render("f%d.pfm", {"--set", "d=0.01:0.1:2"}).code == 0);
    CHECK(fixture.render("one.pfm", {"--set", "d=0.1"}).code == 0);
    CHECK(image(fixture, "f0.pfm") != image(fixture, "f1.pfm"));
    CHECK(image(fixture, "f1.pfm") == image(fixture, "one.pfm"));
}

TEST_CASE("the option --turn moves automatic and fixed cameras around the scene") {
    const ToolFixture fixture;
    CHECK(fixture.render("t%03d.pfm", {"--turn", "360/4"}).code == 0);
    CHECK(!std::filesystem::exists(fixture.path() / "t004.pfm"));
    CHECK(fixture.render("scene.pfm").code == 0);
    CHECK(image(fixture, "t000.pfm") == image(fixture, "scene.pfm"));
    CHECK(image(fixture, "t001.pfm") != image(fixture, "scene.pfm"));
    const ToolFixture other(growing);
    CHECK(other.render("t%d.pfm", {"--turn", "90/2", "--set", "x=0:1:2"}).code == 0);
    CHECK(complaint(other, {"scene.json", "-o", "t%d.pfm", "--turn", "90/2", "--set", "x=0:1:3"})
              .find("as many images as the sequence, 3, got 2") != std::string::npos);
}

TEST_CASE("the option --turn must have as many images as there are frames") {
    const ToolFixture fixture;
    fixture.write("move.xyz", trajectory(5));
    const auto film = [&](const std::string& frames, const std::string& turn,
                          const Options& options = {}) {
        std::filesystem::remove_all(fixture.output());
        std::filesystem::create_directory(fixture.output());
        return joined(
            joined({"move.xyz", "-o", "out/f%d.pfm", "--frames", frames, "--turn", turn}, small),
            options);
    };
    const auto drawn = [&] {
        return std::distance(std::filesystem::directory_iterator(fixture.output()), {});
    };
    const std::string must = "raylane: --turn: must have as many images as the sequence, ";
    CHECK(complaint(fixture, film("0:5", "90/9")) == must + "5, got 9\n");
    CHECK(drawn() == 0);
    // Too few frames are noticed at the end,
    CHECK(complaint(fixture, film("0:9", "90/9")) == must + "5, got 9\n");
    CHECK(drawn() == 5);
    CHECK(complaint(fixture, film("0:", "360/120")) == must + "5, got 120\n");
    CHECK(drawn() == 5);
    // too many frames before the first one in excess,
    CHECK(complaint(fixture, film("0:", "360/3")) == must + "at least 4, got 3\n");
    CHECK(drawn() == 3);
    CHECK(complaint(fixture, film("::2", "360/1", {"--part", "2/2"})) ==
          must + "at least 2, got 1\n");
    CHECK(drawn() == 0);
    // and both before all if all frames are read first.
    for (const char* turn : {"360/3", "360/9"})
        CHECK(complaint(fixture, film(":", turn, {"--camera-from", "all"})) ==
              must + "5, got " + (turn + 4) + "\n");
    CHECK(drawn() == 0);
    for (const char* frames : {":", "0:5", "-5:"}) {
        CHECK(fixture.run(joined({"render"}, film(frames, "90/5"))).code == 0);
        CHECK(drawn() == 5);
    }
}

TEST_CASE("existing images are kept unless --overwrite is given") {
    const ToolFixture fixture(growing);
    const Options sweep = {"--set", "r=1:2:3"};
    CHECK(fixture.render("s%d.pfm", sweep).code == 0);
    const std::string first = image(fixture, "s0.pfm"), last = image(fixture, "s2.pfm");
    fixture.write("s0.pfm", "mine");
    std::filesystem::remove(fixture.path() / "s2.pfm");
    const Outcome again = fixture.render("s%d.pfm", sweep);
    CHECK(again.code == 0);
    CHECK(again.err == "2 of 3 images exist already; --overwrite renders them again\n");
    CHECK(image(fixture, "s0.pfm") == "mine");
    CHECK(image(fixture, "s2.pfm") == last);
    CHECK(fixture.render("s%d.pfm", joined(sweep, {"--force"})).code == 0);
    CHECK(image(fixture, "s0.pfm") == first);
}

TEST_CASE("an interrupted frame sequence resumes where it was") {
    const ToolFixture fixture(growing);
    fixture.write("out/f0.pfm", "drawn");
    const Options film = {"render", "scene.json", "-o", "out/f%d.pfm", "--set", "r=1:2:3"};
    Process process = fixture.start(joined(film, minutes));
    REQUIRE(fixture.wait_for_files(process, 2)); // during the second image
    REQUIRE(fixture.wait_for(fixture.output() / "f1.pfm.part"));
    process.send(SIGINT);
    CHECK(process.wait().code == 128 + SIGINT);
    CHECK(std::filesystem::exists(fixture.output() / "f1.pfm.part"));
    CHECK(std::distance(std::filesystem::directory_iterator(fixture.output()), {}) == 2);
    CHECK(fixture.run(film).err ==
          "raylane: out/f1.pfm.part: belongs to other options or another version; not resumed, "
          "kept until this image is complete\n"
          "1 of 3 images exist already; --overwrite renders them again\n");
    CHECK(std::distance(std::filesystem::directory_iterator(fixture.output()), {}) == 3);
    CHECK(image(fixture, "out/f0.pfm") == "drawn");
    CHECK(std::filesystem::exists(fixture.output() / "f2.pfm"));
}

TEST_CASE("the option --view works for any scene and moves the lights that follow the camera") {
    const ToolFixture fixture;
    const auto convert = [&](const Options& options) {
        const Outcome outcome = fixture.run(joined({"convert", "scene.json", "-"}, options));
        CHECK(outcome.code == 0);
        return nlohmann::json::parse(outcome.out);
    };
    const auto right = convert({"--view", "right", "--orthographic"});
    CHECK(right["camera"]["type"] == "auto"); // keeps the view
    CHECK(right["camera"]["orthographic"] == true);
    CHECK(right["camera"]["view"] == nlohmann::json({-1, 0, 0}));
    CHECK(right["lights"].size() == 1);
    CHECK(convert({"--depth-cue", "0.5"})["fog"]["type"] == "linear");
    CHECK(convert({"--up", "x"})["camera"]["up"] == nlohmann::json({1, 0, 0}));
    CHECK(convert({"--view", "1,1,0", "--up", "0,0,1"})["camera"]["up"] ==
          nlohmann::json({0, 0, 1}));
    CHECK(complaint(fixture, {"scene.json", "--view", "top", "--up", "y"}) ==
          "raylane: --up: must not be parallel to the direction of view\n");
    CHECK(complaint(fixture, {"scene.json", "--view", "1,2,3", "--up", "0.1,0.2,0.3"}) ==
          "raylane: --up: must not be parallel to the direction of view\n");
    CHECK(convert({"--up", "-x"})["camera"]["up"] == nlohmann::json({-1, 0, 0}));
    CHECK(complaint(fixture, {"scene.json", "--up", "0,0,0"})
              .starts_with(
                  "raylane: --up: must be x, y, z, -x, -y or -z, or a direction such as 0,1,1"));
    // --zoom does not move a fixed camera.
    const auto near = convert({"--zoom", "2"});
    CHECK(near["camera"]["from"][2] == 5);
    CHECK(near["camera"]["field_of_view"] < 25);
    fixture.write("floor.json", R"({"camera": {"from": [0, 1, 0], "at": [0, 0, 1]},
        "lights": [{"type": "camera"}],
        "objects": [{"type": "plane", "material": {}, "point": [0, 0, 0], "normal": [0, 1, 0]}]})");
    CHECK(fixture.run({"render", "floor.json"}).code == 0);
    CHECK(complaint(fixture, {"floor.json", "--view", "top"})
              .find("--view: must have a bounded shape to frame") != std::string::npos);
}

TEST_CASE("commands for one scene read any frame") {
    const ToolFixture fixture;
    fixture.write("move.xyz", "1\n\nC 0 0 0\n1\n\nC 1 0 0\n1\n\nC 2 0 0\n");
    fixture.write("figure.txt", "--frames 1:3\n"); // of a sequence; its first frame is shown
    const auto x_in = [&](const Options& options) {
        const Outcome outcome = fixture.run(joined({"convert", "move.xyz", "-"}, options));
        CAPTURE(outcome.err);
        REQUIRE(outcome.code == 0);
        return nlohmann::json::parse(outcome.out)["objects"][0]["center"][0].get<int>();
    };
    CHECK(x_in({}) == 0);
    CHECK(x_in({"--frames", "1"}) == 1);
    CHECK(x_in({"--frames", "-1"}) == 2);
    CHECK(x_in({"@figure.txt"}) == 1);
    const Outcome outside = fixture.run({"info", "move.xyz", "--frames", "3"});
    CHECK(outside.code == 2);
    CHECK(outside.err == "raylane: --frames: must select some of the 3 frames that move.xyz has, "
                         "numbered from 0, got none\n");
    fixture.write("scene.json", growing);
    CHECK(fixture.run({"info", "scene.json", "--frames", "1"}).err ==
          "raylane: --frames: goes with a file of atoms, but scene.json is a scene\n");
}

TEST_CASE("scenes of other programs accept --view and --turn but not --frames") {
    const ToolFixture fixture;
    fixture.write("ball.pov", R"(camera { location <0, 0, -5> look_at 0 angle 40 }
light_source { <9, 9, -9> color rgb 1 }
sphere { <0, 0, 0>, 1 pigment { color rgb <1, 0, 0> } }
)");
    fixture.write("ball.dat", R"(BEGIN_SCENE
RESOLUTION 16 12
CAMERA
ZOOM 1 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 9
CENTER 0 0 -5 VIEWDIR 0 0 1 UPDIR 0 1 0
END_CAMERA
DIRECTIONAL_LIGHT DIRECTION 1 -1 1 COLOR 1 1 1
TEXDEF RED AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 0 0 TEXFUNC 0
SPHERE CENTER 0 0 0 RAD 1 RED
END_SCENE
)");
    for (const std::string name : {"ball.pov", "ball.dat"}) {
        CAPTURE(name);
        const auto camera = [&](const Options& options) {
            const Outcome outcome = fixture.run(joined({"convert", name, "-"}, options));
            CAPTURE(outcome.err);
            CHECK(outcome.code == 0);
            return nlohmann::json::parse(outcome.out)["camera"];
        };
        const auto own = camera({});
        CHECK(own["from"][2] == 5);
        const auto zoomed = camera({"--zoom", "2"});
        CHECK(zoomed["from"] == own["from"]);
        CHECK(zoomed["field_of_view"] < own["field_of_view"]);
        CHECK(camera({"--orthographic"})["type"] == "orthographic");
        const auto right = camera({"--view", "right"});
        CHECK(right["view"] == nlohmann::json({-1, 0, 0}));
        CHECK(right["field_of_view"] == own["field_of_view"]);
        CHECK(fixture
                  .run(joined({"render", name, "-o", name + "%d.pfm", "--turn", "180/2", "--quiet"},
                              small))
                  .code == 0);
        CHECK(image(fixture, name + "0.pfm") != image(fixture, name + "1.pfm"));
        CHECK(complaint(fixture, {name, "--frames", "0:2"}) ==
              "raylane: --frames: goes with a file of atoms, but " + name + " is a scene\n");
        CHECK(complaint(fixture, {name, "--set", "n=1:2:2"})
                  .find("only JSON scenes have parameters") != std::string::npos);
    }
}

TEST_CASE("mistakes about several images give an error of one line") {
    const ToolFixture fixture(growing);
    fixture.write("move.xyz", trajectory(2));
    const auto says = [&](const Options& options, const std::string& what) {
        INFO(what);
        const std::string said = complaint(fixture, options);
        INFO(said);
        CHECK(said.find(what) != std::string::npos);
    };
    for (const char* pattern : {"p.png", "p%d%d.png", "p%s.png", "p%n.png", "p%.png", "p%05x.png",
                                "p%1000d.png", "%", "p%ld.png"})
        says({"scene.json", "-o", pattern, "--set", "r=1:2:2"},
             "--output: must have one placeholder");
    says({"scene.json", "--set", "r"}, "--set: must be NAME=NUMBER");
    says({"scene.json", "--set", "r=1:2"}, "--set: must be NAME=NUMBER");
    says({"scene.json", "--set", "r=1:2:0"}, "--set: must be NAME=NUMBER");
    says({"scene.json", "--set", "1=1"}, "--set: must be NAME=NUMBER");
    says({"scene.json", "--set", "r=nan"}, "--set: must be NAME=NUMBER");
    says({"scene.json", "--set", "r=1", "--set", "r=2"}, "--set: must set \"r\" only once");
    says({"scene.json", "--set", "r=1:2:2", "--set", "x=1:2:3"},
         "the same number of values in all sweeps, got 2 and 3");
    says({"scene.json", "--set", "q=1"}, "scene.json: has no parameter \"$q\"");
    says({"scene.json", "--frames", "0:2"}, "--frames: goes with a file of atoms");
    says({"move.xyz", "--set", "r=1"}, "only JSON scenes have parameters");
    says({"move.xyz", "--frames", "0:2:0"}, "--frames: must be");
    says({"move.xyz", "--frames", "a"}, "--frames: must be");
    says({"move.xyz", "--frames", ""}, "--frames: must be");
    says({"move.xyz", "--frames", "2", "-o", "x.png"}, "of the 2 frames");
    says({"move.xyz", "--frames", "-3", "-o", "x.png"},
         "--frames: must select some of the 2 frames that move.xyz has, numbered from 0, got "
         "none\n");
    fixture.write("nothing", "");
    says({"nothing", "--frames", "0:2"}, "nothing: must be a scene or atoms, got an empty file");
    says({"move.xyz", "--frames", "0:2", "-o", "f%d.gif"}, "f0.gif: must end in");
    says({"move.xyz", "--frames", "1:1"}, "--frames: must select at least one frame");
    says({"scene.json", "--turn", "360"}, "--turn: must be DEGREES/IMAGES");
    says({"scene.json", "--turn", "360/0"}, "--turn: must be DEGREES/IMAGES");
    says({"scene.json", "--turn", "360/4", "--camera-from", "last"}, "--camera-from: must be");
    says({"scene.json", "--turn", "360/4", "--stats", "s.json"},
         "--stats: goes with a single image");
    CHECK(fixture.run({"info", "scene.json", "--set", "r=1:2:3"})
              .err.find("must be NAME=NUMBER for this command") != std::string::npos);
}

TEST_CASE("a malformed frame ends the sequence after the frames before it") {
    const ToolFixture fixture;
    fixture.write("move.xyz", trajectory(2) + "3\n\nO 0 0 zero\nH 1 0 0\nH 0 1 0\n");
    const Outcome outcome =
        fixture.run(joined({"render", "move.xyz", "-o", "f%d.pfm", "--frames", ":"}, small));
    CHECK(outcome.code == 2);
    CHECK(is_one_line(outcome.err));
    CHECK(outcome.err.find("13") != std::string::npos);
    CHECK(std::filesystem::exists(fixture.path() / "f1.pfm"));
    CHECK(!std::filesystem::exists(fixture.path() / "f2.pfm"));
}
