#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

/// Tests of options for figures in print.
using namespace raylane;
using namespace raylane::tests;

namespace {

const std::string water = "3\nProperties=species:S:1:pos:R:3:charge:R:1\n"
                          "O 0 0 0 -0.8\nH 0.96 0 0 0.4\nH -0.24 0.93 0 0.4\n";

class Figures : public ToolFixture {
  public:
    Figures() { write("water.xyz", water); }

    Outcome figure(const std::string& name, const Options& options) const {
        return run(joined({"render", "water.xyz", "-o", name, "--spp", "1"}, options));
    }
    scenes::Image drawn(const std::string& name, const Options& options) const {
        REQUIRE(figure(name, options).code == 0);
        return scenes::read_image(path() / name);
    }
    bool verifies(const std::string& name) const {
        return run({"verify", name, "water.xyz", "--whole", "-q"}).code == 0;
    }
    std::string error(const Options& options) const {
        const Outcome outcome = figure("error.png", options);
        CHECK(outcome.code != 0);
        CHECK(is_one_line(outcome.err));
        return outcome.err;
    }
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("a size on paper has the pixels of its resolution") {
    const Figures fixture;
    const scenes::Image image = fixture.drawn("a.png", {"--size", "8.5mm", "--dpi", "600"});
    CHECK(image.width == 201);  // 8.5 / 25.4 * 600 = 200.8
    CHECK(image.height == 151); // 4:3
    CHECK(fixture.verifies("a.png"));
    const scenes::Image inches = fixture.drawn("b.png", {"--size", "0.4x0.25in"});
    CHECK(inches.width == 120); // at 300 pixels per inch
    CHECK(inches.height == 75);
    CHECK(has(content_of(fixture.path() / "b.png"), "pHYs"));
    CHECK(has(fixture.error({"--size", "8.5furlongs"}), "must be a size on paper"));
    CHECK(has(fixture.error({"--size", "0.0001mm"}), "must have from 1 to 65535 pixels"));
}

TEST_CASE("a camera that view prints is the camera of an image") {
    const Figures fixture;
    const std::string camera =
        R"("camera": {"from": [1, 2, 9], "at": [0.5, 0, 0], "up": [0, 1, 0],)"
        R"( "field_of_view": 20})";
    const Options size = {"--size", "40x30"};
    const scenes::Image image = fixture.drawn("a.png", joined(size, {"--camera", camera}));
    CHECK(fixture.verifies("a.png"));
    const scenes::Image same =
        fixture.drawn("b.png", joined(size, {"--camera", camera.substr(camera.find('{'))}));
    CHECK(image.rgb.is_same(same.rgb));
    CHECK(!image.rgb.is_same(fixture.drawn("c.png", size).rgb));
    CHECK(has(fixture.error({"--camera", "{\"from\": 3}"}), "raylane: --camera:"));
    CHECK(has(fixture.error({"--camera", camera, "--view", "top"}), "goes without"));
}

TEST_CASE("looks, backgrounds and views are recorded") {
    const Figures fixture;
    const Options size = {"--size", "40x30"};
    const scenes::Image black = fixture.drawn("a.png", joined(size, {"--background", "black"}));
    CHECK(black.rgb[0] == 0.0F);
    CHECK(fixture.verifies("a.png"));
    CHECK(fixture.drawn("b.png", joined(size, {"--background", "none"})).alpha[0] == 0.0F);
    CHECK(fixture.verifies("b.png"));
    CHECK(has(fixture.error({"--background", "blac"}), "did you mean \"black\"?"));
    const scenes::Image parts = fixture.drawn("p.png", joined(size, {"--background", "0,1,0"}));
    CHECK(parts.rgb[0] == 0.0F);
    CHECK(parts.rgb[1] == 1.0F);
    CHECK(fixture.verifies("p.png"));
    for (const std::string look : {"matte", "glossy", "flat", "print"}) {
        const scenes::Image image =
            fixture.drawn("c.png", joined(size, {"--look", look, "--view", "best"}));
        CHECK(fixture.verifies("c.png"));
        CHECK(!image.rgb.is_same(fixture.drawn("d.png", joined(size, {"--view", "best"})).rgb));
    }
    const Outcome scene = fixture.render("e.png", {"--background", "black"});
    CHECK(scene.err == "raylane: --background: goes with a file of atoms, but scene.json is a "
                       "scene\n");
}

TEST_CASE("images without alpha have a background") {
    const Figures fixture;
    for (const char* name : {"a.tga", "a.bmp", "a.ppm", "a.hdr", "a.pfm"})
        CHECK(fixture.figure(name, {"--size", "4x3", "--background", "none"}).err ==
              "raylane: --background: none goes with PNG, TIFF or EXR\n");
    CHECK(fixture.figure("a-%d.bmp", {"--size", "4x3", "--background", "none", "--turn", "360/2"})
              .err == "raylane: --background: none goes with PNG, TIFF or EXR\n");
}

TEST_CASE("an option without its value does not take the next option") {
    const Figures fixture;
    const std::string end = "; see raylane render --help\n";
    CHECK(fixture.error({"--transparent-shadows", "--size", "4x3"}) ==
          "raylane: --transparent-shadows: must have a value, on|off" + end);
    CHECK(fixture.error({"--cut", "--size", "4x3"}) ==
          "raylane: --cut: must have a value, PLANE" + end);
    CHECK(fixture.error({"--slab", "--size", "4x3"}) ==
          "raylane: --slab: must have a value, A B" + end);
    CHECK(has(fixture.error({"--transparent-shadows", "no"}), "did you mean \"off\"?"));
    CHECK(has(fixture.error({"--transparent-shadows", "yes"}), "did you mean \"on\"?"));
}

TEST_CASE("views along negative axes are opposite to those along axes") {
    const Figures fixture;
    const Options size = {"--size", "40x30"};
    const auto view = [&](const char* name, const Options& words) {
        return fixture.drawn(name, joined(size, words)).rgb;
    };
    CHECK(view("a.png", {"--view", "-y"})
              .is_same(view("b.png", {"--view", "0,1,0", "--up", "0,0,1"})));
    CHECK(fixture.verifies("a.png"));
    CHECK(view("a.png", {"--view", "-z"}).is_same(view("b.png", {"--view", "back"})));
    CHECK(!view("a.png", {"--view", "-z"}).is_same(view("b.png", {"--view", "z"})));
}

TEST_CASE("a TIFF is verified and compared like a PNG") {
    const Figures fixture;
    const Outcome made = fixture.figure("a.tif", {"--size", "20x15", "--bits", "16"});
    if (made.code != 0) {
        CHECK(has(made.err, "libtiff-dev"));
        return;
    }
    CHECK(fixture.verifies("a.tif"));
    CHECK(fixture.figure("a.png", {"--size", "20x15", "--bits", "16"}).code == 0);
    CHECK(fixture.run({"compare", "a.tif", "a.png"}).code == 0);
    std::string bytes = content_of(fixture.path() / "a.tif");
    const std::size_t options = bytes.find("--size 20x15");
    REQUIRE(options != std::string::npos);
    bytes.replace(options, 12, "--size 20x16");
    fixture.write("b.tif", bytes);
    CHECK(!fixture.verifies("b.tif"));
}

TEST_CASE("a view along an edge of a cell needs atoms and a cell") {
    const Figures fixture;
    CHECK(has(fixture.error({"--view", "a"}), "--view: must have a cell"));
    CHECK(fixture.render("e.png", {"--view", "c"}).err ==
          "raylane: --view: goes with a file of atoms, but scene.json is a scene\n");
    CHECK(fixture.render("f.png", {"--view", "best", "--size", "4x3"}).code == 0);
    CHECK(has(fixture.error({"--view", "bset"}), "did you mean \"best\"?"));
}

TEST_CASE("cuts and slabs are recorded") {
    const Figures fixture;
    const scenes::Image cut =
        fixture.drawn("a.png", {"--size", "40x30", "--cut", "z<0.2", "--slab", "-1", "0.1"});
    CHECK(fixture.verifies("a.png"));
    CHECK(!cut.rgb.is_same(fixture.drawn("b.png", {"--size", "40x30"}).rgb));
    CHECK(fixture.figure("c.png", {"--size", "4x3", "--slab", "-1:1", "--view", "best"}).code == 0);
    CHECK(fixture.verifies("c.png"));
    // A file behind two numbers, or behind one word, is the scene.
    for (const Options& slab : {Options{"--slab", "-1", "0.1"}, Options{"--slab", "-1:0.1"}}) {
        const Outcome made = fixture.run(
            joined({"render", "--size", "4x3"}, joined(slab, {"water.xyz", "-o", "e.png"})));
        CHECK(made.err.empty());
    }
    CHECK(has(fixture.error({"--cut", "z<-9"}), "--cut: must leave a part of the atoms"));
    const Options words[] = {{"--slab", "-1", "0.1"}, {"--slab", "-1:0.1"}, {"--slab=-1:0.1"},
                             {"--slab", "-1,0.1"},    {"--slab=-1,0.1"},    {"--slab", "-1 0.1"}};
    for (const Options& slab : words) {
        CAPTURE(slab);
        CHECK(cut.rgb.is_same(
            fixture.drawn("d.png", joined({"--size", "40x30", "--cut", "z<0.2"}, slab)).rgb));
        CHECK(fixture.verifies("d.png"));
    }
}

TEST_CASE("annotations in a file leave the image as it is") {
    const Figures fixture;
    const Options options = {"--size", "80x60", "--color", "charge"};
    const scenes::Image plain = fixture.drawn("plain.png", options);
    const Options annotated =
        joined(options, {"--legend", "--label", "element O: {name}", "--scale-bar", "auto"});
    const scenes::Image beside = fixture.drawn(
        "a.png", joined(annotated, {"--annotations", "a.svg", "--stats", "stats.json"}));
    CHECK(beside.rgb.is_same(plain.rgb));
    CHECK(fixture.verifies("a.png"));
    const std::string svg = content_of(fixture.path() / "a.svg");
    CHECK(has(svg, "viewBox=\"0 0 80 60\""));
    CHECK(has(svg, "id=\"legend-charge\""));
    CHECK(has(svg, "id=\"label-1\""));
    const auto stats = nlohmann::json::parse(content_of(fixture.path() / "stats.json"));
    REQUIRE(stats["legend"].size() == 1);
    CHECK(stats["legend"][0]["property"] == "charge");
    CHECK(std::abs(stats["legend"][0]["range"][0].get<double>() + 0.8) < 1e-6);
    CHECK(stats["legend"][0]["colors"].size() == 9);
    CHECK(has(fixture.error({"--font", "Arial"}), "--font: goes with --legend"));
    CHECK(has(fixture.error({"--legend", "--annotations", "water.xyz"}), "--annotations: must"));
    CHECK(has(fixture.error({"--legend", "--annotations", "a.png"}),
              "--annotations: must end with .svg, got \"a.png\""));
    CHECK(has(fixture.error({"--label", "all: {elemnt}"}), "did you mean \"{element}\"?"));
    CHECK(has(fixture.error({"--label", "element Fe: x", "--annotations", "b.svg"}),
              "--label: \"element Fe\" selects none of 3 atoms"));
    CHECK(has(fixture.error({"--legend", "--part", "1/2", "--bits", "32"}),
              "--legend: goes with a whole image, without --part"));
    // Texts on the image need a module, which may be missing.
    const Outcome over = fixture.figure("over.png", annotated);
    if (over.code != 0) {
        CHECK(has(over.err, "libpango1.0-dev"));
        return;
    }
    CHECK(over.err.find("--font:") == std::string::npos);
    const Outcome other = fixture.figure("font.png", joined(annotated, {"--font", "No Such Font"}));
    CHECK(has(other.err, "--font: \"No Such Font\" is not installed: texts are in "));
    CHECK(!scenes::read_image(fixture.path() / "over.png").rgb.is_same(plain.rgb));
    CHECK(fixture.verifies("over.png"));
}

TEST_CASE("each image of a sequence has its annotations") {
    const Figures fixture;
    fixture.write("two.xyz", "2\n\nO 0 0 0\nC 3 0 0\n2\n\nO 0 0 0\nC 2 0 0\n");
    const Options options = {
        "--size",     "160x120",          "--spp",       "1",   "--label", "element C: carbon",
        "--distance", "index 1: index 2", "--scale-bar", "auto"};
    const auto render = [&](const Options& more) {
        return fixture.run(joined(joined({"render", "two.xyz"}, options), more));
    };
    const auto file = [&](const std::string& name) { return content_of(fixture.path() / name); };
    const Outcome outcome = render({"-o", "f%d.png", "--frames", ":", "--annotations", "f%d.svg"});
    REQUIRE(outcome.code == 0);
    CHECK(has(file("f0.svg"), ">3.00 \u00c5</text>"));
    CHECK(has(file("f1.svg"), ">2.00 \u00c5</text>"));
    CHECK(has(file("f1.svg"), ">carbon</text>"));
    // The remark on perspective is printed once.
    CHECK(outcome.err.find("--scale-bar holds") == outcome.err.rfind("--scale-bar holds"));
    CHECK(has(outcome.err, "--scale-bar holds"));
    REQUIRE(render({"-o", "t%d.png", "--turn", "360/2", "--annotations", "t%d.svg"}).code == 0);
    CHECK(file("t0.svg") != file("t1.svg"));
    REQUIRE(render({"-o", "one%d.png", "--frames", "1", "--annotations", "one%d.svg"}).code == 0);
    CHECK(has(file("one1.svg"), ">2.00 \u00c5</text>"));
    REQUIRE(render({"-o", "one.png", "--frames", "1", "--annotations", "one.svg"}).code == 0);
    CHECK(file("one.svg") == file("one1.svg"));
    const Outcome unnumbered = render({"-o", "u%d.png", "--frames", ":", "--annotations", "u.svg"});
    CHECK(unnumbered.code == 2);
    CHECK(has(unnumbered.err, "--annotations: must have one placeholder for the image number"));
    if (render({"-o", "over%d.png", "--frames", ":"}).code != 0) return; // without Pango
    CHECK(!scenes::read_image(fixture.path() / "over1.png")
               .rgb.is_same(scenes::read_image(fixture.path() / "f1.png").rgb));
    CHECK(fixture.run({"verify", "over1.png", "two.xyz", "--whole", "-q"}).code == 0);
    CHECK(fixture.run({"verify", "over0.png", "two.xyz", "--whole", "-q"}).code == 0);
}
