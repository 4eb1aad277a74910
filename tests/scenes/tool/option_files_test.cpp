#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

/// Tests of files of options, "@FILE" on the command line.
using namespace raylane;
using namespace raylane::tests;

namespace {

const std::string water = "3\nwater\nO 0 0 0\nH 0.96 0 0\nH -0.24 0.93 0\n";

class Figures : public ToolFixture {
  public:
    Figures() { write("water.xyz", water); }

    Outcome figure(const std::string& options, const Options& more = {}) const {
        write("figure.txt", options);
        return run(joined({"render", "@figure.txt", "-o", "a.png"}, more));
    }
    std::string comment() const {
        const scenes::Image image = scenes::read_image(path() / "a.png");
        for (const auto& [name, text] : image.texts)
            if (name == "Comment") return text;
        return "";
    }
    bool records(const std::string& option) const {
        return (" " + comment() + " ").find(" " + option + " ") != std::string::npos;
    }
};

bool names(const std::string& message, const std::string& part) {
    return message.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("a file of options has the effect of the command line") {
    const Figures fixture;
    REQUIRE(fixture
                .figure("# all figures\r\n\n  --size 20x10\n--spp=4\n--show all: sticks orange\n"
                        "--orthographic\n--color \"carbons chain\"\nwater.xyz\n--range 0:5\n")
                .code == 0);
    CHECK(fixture.records("--size 20x10"));
    CHECK(fixture.records("--spp 4"));
    CHECK(fixture.records("--show \"all: sticks orange\""));
    CHECK(fixture.records("--color \"carbons chain\""));
    CHECK(fixture.run({"verify", "a.png", "water.xyz", "--whole", "-q"}).code == 0);
    REQUIRE(fixture
                .run({"render", "water.xyz", "-o", "b.png", "--size", "20x10", "--spp", "4",
                      "--show", "all: sticks orange", "--orthographic", "--color", "carbons chain",
                      "--range", "0:5"})
                .code == 0);
    CHECK(content_of(fixture.path() / "a.png") == content_of(fixture.path() / "b.png"));
}

TEST_CASE("the command line overrides files and a file overrides earlier ones") {
    const Figures fixture;
    fixture.write("paper.txt", "--size 20x10\n--quality 30\n--show all: balls\n--zoom 2\n");
    REQUIRE(
        fixture
            .figure("--zoom 3\n--spp 4\n--show element O: balls red\n",
                    {"@paper.txt", "water.xyz", "--size=30x20", "--show", "index 1: balls blue"})
            .code == 0);
    CHECK(fixture.records("--size 30x20"));
    CHECK(fixture.records("--zoom 2")); // paper.txt comes last here
    CHECK(fixture.records("--quality 30"));
    CHECK(fixture.records("--show \"element O: balls red\" --show \"all: balls\" --show \"index 1: "
                          "balls blue\""));
    // An option of the command line that excludes one of a file replaces it.
    REQUIRE(fixture.figure("--quality 30\n", {"water.xyz", "--draft", "--size", "20x10"}).code ==
            0);
    CHECK(fixture.records("--spp 1"));
}

TEST_CASE("mistakes in a file of options name file and line") {
    const Figures fixture;
    const auto error = [&](const std::string& options, const Options& more = {"water.xyz"}) {
        const Outcome outcome = fixture.figure(options, more);
        CHECK(outcome.code == 2);
        CHECK(is_one_line(outcome.err));
        return outcome.err;
    };
    CHECK(error("#\n--siez 3x3\n") ==
          "raylane: figure.txt:2: unknown option \"--siez\", did you mean \"--size\"?\n");
    CHECK(error("--spp 5\n") == "raylane: figure.txt:1: --spp: must be a square number from 1 to "
                                "65536, such as 1, 4, 9 or 16, got \"5\"\n");
    CHECK(error("--max-see-through 0\n") == // the former name
          "raylane: figure.txt:1: --max-transparent: must be a whole number from 1 to 1000000, "
          "got \"0\"\n");
    CHECK(error("\n--spp\n") == "raylane: figure.txt:2: --spp: must have a value, N\n");
    CHECK(error("--orthographic yes\n") ==
          "raylane: figure.txt:1: --orthographic: must have no value\n");
    CHECK(error("--spp 4\n--spp 9\n") ==
          "raylane: figure.txt:2: --spp: must be given only once, got it in line 1, too\n");
    CHECK(error("--show all: balls\n--show all: bals\n").find("raylane: figure.txt:2: ") == 0);
    // These are found once the atoms are known.
    CHECK(error("--size 20x10\n--select chain Z\n").find("raylane: figure.txt:2: --select: ") == 0);
    CHECK(error("--spp 4\n--quality 30\n").find("raylane: figure.txt:") == 0);
    CHECK(fixture.run({"render", "@none.txt"}).err == "raylane: none.txt: no such file\n");
}

TEST_CASE("other commands ignore the options that only render has") {
    const Figures fixture;
    fixture.write("figure.txt", "--spp 4\n--style sticks\n--sqq 4\n");
    CHECK(
        fixture.run({"convert", "water.xyz", "a.json", "@figure.txt"}).err.find("figure.txt:3: ") !=
        std::string::npos);
    fixture.write("figure.txt", "--spp 4\n--style sticks\n");
    REQUIRE(fixture.run({"convert", "water.xyz", "a.json", "@figure.txt"}).code == 0);
    REQUIRE(fixture.run({"convert", "water.xyz", "b.json", "--style", "sticks"}).code == 0);
    CHECK(content_of(fixture.path() / "a.json") == content_of(fixture.path() / "b.json"));
}

TEST_CASE("a line that has lost the dashes of its option is refused") {
    const Figures fixture;
    CHECK(names(fixture.figure("size 20x10\n", {"water.xyz"}).err,
                "figure.txt:1: must begin with dashes: --size"));
    fixture.write("figure.txt", "spp 4\n");
    CHECK(names(fixture.run({"convert", "water.xyz", "a.json", "@figure.txt"}).err,
                "figure.txt:1: must begin with dashes: --spp"));
    fixture.write("size", water);
    CHECK(fixture.figure("size\n").code == 0); // a file of this name
}

TEST_CASE("a value that begins with @ is not a file") {
    const Figures fixture;
    CHECK(fixture.run({"render", "water.xyz", "--select", "@none"}).err.find("no such file") ==
          std::string::npos);
}

TEST_CASE("a comment or another option behind a value gets a hint") {
    const Figures fixture;
    const std::string alone = ": put it on another line, or the value between quotes";
    CHECK(names(fixture.figure("water.xyz\n--size 20x10 --spp 4\n").err,
                "figure.txt:2: must be one option a line, got --spp, too" + alone));
    CHECK(names(fixture.figure("water.xyz\n--size 20x10 --spp=4\n").err,
                "figure.txt:2: must be one option a line, got --spp=4, too" + alone));
    CHECK(names(fixture.figure("water.xyz\n--orthographic --size 20x10\n").err,
                "figure.txt:2: must be one option a line, got --size, too" + alone));
    for (const char* comment : {"# for the paper", "#small"})
        CHECK(names(fixture.figure(std::string("water.xyz\n--size 20x10 ") + comment + "\n").err,
                    "figure.txt:2: must have no comment behind a value: put the comment on another "
                    "line, or the value between quotes"));
    fixture.write("a # b --size.xyz", water);
    REQUIRE(
        fixture.figure("\"a # b --size.xyz\"\n--size 20x10\n--show all: sticks #ff0000\n").code ==
        0);
    CHECK(fixture.records("--size 20x10"));
    CHECK(fixture.records("--show \"all: sticks #ff0000\""));
}
