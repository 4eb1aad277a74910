#include "scenes/images/reader.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace raylane;
using namespace raylane::tests;

namespace {

using Json = nlohmann::json;

Json json_of(const Outcome& outcome) {
    CHECK(outcome.err.empty());
    return Json::parse(outcome.out);
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("info lists the content and the needs of a scene") {
    const ToolFixture fixture;
    const Outcome text = fixture.run({"info", "scene.json"});
    CHECK(text.code == 0);
    CHECK(text.err.empty());
    for (const char* line :
         {"shapes     1: 1 sphere\n", "extent     x from ", "lights     1\n", "fog        none\n",
          "image      16 x 12 pixels, ", "limits     depth 8, weight 0.001\n"})
        CHECK(contains(text.out, line));

    const Outcome outcome = fixture.run({"info", "--json", "scene.json"});
    CHECK(outcome.code == 0);
    const Json info = json_of(outcome);
    CHECK(info["scene"] == "scene.json");
    CHECK(info["shapes"] == Json{{"sphere", 1}});
    CHECK(info["bounds"]["lower"].size() == 3);
    CHECK(info["bounds"]["lower"][0] < info["bounds"]["upper"][0]);
    CHECK(info["width"] == 16);
    CHECK(info["height"] == 12);
    CHECK(info["camera"] == "perspective");
    CHECK(info["film_bytes"] == 16 * 12 * 3 * 4);
    CHECK(info["min_weight"].dump() == "0.001");
    const auto has = [&](const char* key, const char* name) {
        return std::count(info[key].begin(), info[key].end(), name) == 1;
    };
    CHECK(has("needed", "reflected rays"));
    CHECK(has("left_out", "refracted rays"));
    CHECK(fixture.names() == std::vector<std::string>{"out", "scene.json"});
}

TEST_CASE("info lists the words and numbers for selections of atoms") {
    const ToolFixture fixture;
    fixture.write("a.xyz",
                  "3\nProperties=species:S:1:pos:R:3:resname:S:1:resid:I:1:chain:S:1:charge:R:1\n"
                  "O 0 0 0 HOH 1 A -0.5\nH 1 0 0 HOH 1 A 0.25\nC 9 0 0 LIG 2 B 0.75\n");
    const Json atoms = json_of(fixture.run({"info", "--json", "a.xyz"}))["atoms"];
    CHECK(atoms["count"] == 3);
    CHECK(atoms["elements"] == Json{{"C", 1}, {"H", 1}, {"O", 1}});
    CHECK(atoms["chains"] == Json{{"A", 1}, {"B", 1}});
    CHECK(atoms["residues"] == Json{{"HOH", 1}, {"LIG", 1}});
    CHECK(atoms["numbers"] == Json::array({{{"name", "charge"}, {"min", -0.5}, {"max", 0.75}}}));
    const Outcome text = fixture.run({"info", "a.xyz"});
    for (const char* line : {"atoms      3\n", "elements   1 C, 1 H, 1 O\n",
                             "chains     1 residue in A, 1 residue in B\n",
                             "residues   1 HOH, 1 LIG\n", "numbers    charge from -0.5 to 0.75\n"})
        CHECK(contains(text.out, line));
    CHECK(json_of(fixture.run({"info", "--json", "scene.json"}))["atoms"].is_null());
    fixture.write("b.xyz", "2\nProperties=species:S:1:pos:R:3:q:R:1:p:R:1\n"
                           "Zz 0 0 0 nan nan\nC 1 0 0 2 inf\n"); // p has no finite number
    const Json others = json_of(fixture.run({"info", "--json", "b.xyz"}))["atoms"];
    CHECK(others["elements"] == Json{{"C", 1}});
    CHECK(others["types"] == Json{{"Zz", 1}});
    CHECK(others["chains"].empty());
    CHECK(others["numbers"] == Json::array({{{"name", "q"}, {"min", 2.0}, {"max", 2.0}}}));
    CHECK(contains(fixture.run({"info", "b.xyz"}).out, "numbers    q from 2 to 2\n"));
}

TEST_CASE("info gives the extent of copies, and none of planes") {
    const ToolFixture fixture;
    const auto bounds_with = [&](const std::string& object) {
        fixture.write(
            "a.json",
            R"({"camera": {"from": [0, 0, 60], "at": [0, 0, 0]}, "lights": [], "materials": {"m": {}},
            "definitions": {"balls": {"type": "group", "objects": [
                {"type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 1},
                {"type": "sphere", "material": "m", "center": [3, 0, 0], "radius": 1}]}},
            "objects": [)" +
                object + "]}");
        return json_of(fixture.run({"info", "--json", "a.json"}))["bounds"];
    };
    CHECK(bounds_with(
              R"({"type": "plane", "material": "m", "point": [0, 0, 0], "normal": [0, 1, 0]})")
              .is_null());
    const Json copies = bounds_with(R"({"type": "instance", "of": "balls", "placements": [
        {"translate": [0, 0, 0]}, {"translate": [0, 9, 0]}]})");
    CHECK(copies["upper"][0] >= 4.0);
    CHECK(copies["upper"][0] < 4.01);
    CHECK(copies["upper"][1] >= 10.0);
}

TEST_CASE("info gives the memory of doubles") {
    const ToolFixture fixture;
    const auto info_with = [&](const std::string& radius) {
        fixture.write("ball.json", R"({
            "camera": {"from": [0, 0, 6], "at": [0, 0, 0]},
            "lights": [{"type": "directional", "direction": [0, -1, -1]}],
            "materials": {"plain": {}},
            "objects": [{"type": "sphere", "material": "plain", "center": [0, 0, 0],
                         "radius": )" + radius +
                                       "}]}");
        return json_of(fixture.run({"info", "--json", "ball.json"}));
    };
    const auto needs = [](const Json& info) {
        const auto needed = info["needed"].get<std::vector<std::string>>();
        return std::find(needed.begin(), needed.end(), "double-precision shapes") != needed.end();
    };
    const Json in_floats = info_with("0.5"), in_doubles = info_with("0.1");
    CHECK(!needs(in_floats));
    CHECK(in_floats["double_bytes"] == 0);
    CHECK(needs(in_doubles));
    CHECK(in_doubles["double_bytes"] == 5 * 16 * 8); // a block of four numbers, and one more row
    CHECK(in_doubles["scene_bytes"] == in_floats["scene_bytes"].get<int>() + 5 * 16 * 8);
    CHECK(fixture.run({"info", "ball.json"}).out.find("640 bytes of doubles") != std::string::npos);
}

TEST_CASE("compare reports whether and by how much images differ") {
    const ToolFixture fixture;
    for (const char* name : {"a.png", "b.png", "a.hdr", "b.hdr", "a.pfm", "b.pfm"})
        REQUIRE(fixture.render(name).code == 0);
    for (const char* ending : {".png", ".hdr", ".pfm"}) {
        const Outcome same =
            fixture.run({"compare", std::string("a") + ending, std::string("b") + ending});
        CHECK(same.code == 0);
        CHECK(same.err.empty());
        CHECK(contains(same.out, "differing  0 of 192 pixels"));
    }
    // HDR has eight bits of mantissa alone.
    CHECK(fixture.run({"compare", "a.hdr", "a.pfm"}).code == 1);
    CHECK(fixture.run({"compare", "a.hdr", "a.pfm", "--tolerance", "0.01"}).code == 0);

    REQUIRE(fixture.render("a.png", {"--transfer", "linear"}).code == 0);
    REQUIRE(fixture.render("b.png", {"--transfer", "linear", "--max-depth", "0"}).code == 0);
    const Outcome different =
        fixture.run({"compare", "a.png", "b.png", "--json", "--diff", "out/difference.png"});
    CHECK(different.code == 1);
    const Json json = json_of(different);
    CHECK(json["pixels"] == 192);
    CHECK(json["differing"] > 0);
    CHECK(json["differing"] < 192);
    CHECK(json["rmse"] > 0.0);
    CHECK(json["psnr"] > 0.0);
    CHECK(json["tolerance"] == 0.0);
    const scenes::Image a = scenes::read_image(fixture.path() / "a.png"),
                        b = scenes::read_image(fixture.path() / "b.png"),
                        difference = scenes::read_image(fixture.output() / "difference.png");
    REQUIRE(difference.rgb.size() == a.rgb.size());
    float largest = 0.0F;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        CHECK((difference.rgb[i] > 0.0F) == (a.rgb[i] != b.rgb[i]));
        largest = std::max(largest, difference.rgb[i]);
    }
    CHECK(largest == 1.0F);

    const std::string tolerance = json["largest"].dump();
    CHECK(fixture.run({"compare", "a.png", "b.png", "--tolerance", "0.1"}).code == 1);
    CHECK(fixture.run({"compare", "a.png", "b.png", "--tolerance", "1"}).code == 0);
    CHECK(json_of(fixture.run({"compare", "a.png", "a.png", "--json"}))["psnr"].is_null());
    CHECK(json_of(fixture.run(
              {"compare", "a.png", "b.png", "--json", "--tolerance", "0.1"}))["tolerance"]
              .dump() == "0.1");
}

TEST_CASE("images that cannot be compared give an error of one line") {
    const ToolFixture fixture;
    REQUIRE(fixture.render("a.png").code == 0);
    REQUIRE(fixture.render("b.png", {"--size", "4x5"}).code == 0);
    REQUIRE(fixture.render("c.pfm").code == 0);
    fixture.write("cut.png", content_of(fixture.path() / "a.png").substr(0, 60));
    fixture.write("empty.png", "");
    const std::vector<std::pair<std::string, std::string>> rows = {
        {"b.png", "must have 16 x 12 pixels as a.png has, got 4 x 5 pixels"},
        {"c.pfm", "must have integer codes as a.png has, got linear floats"},
        {"none.png", "no such file"},
        {"out", "must be a file, got a directory"},
        {"cut.png", "must be a PNG, TIFF, EXR, HDR or PFM image, got a damaged PNG"},
        {"empty.png", "must be a PNG, TIFF, EXR, HDR or PFM image, got another format"},
        {"scene.json", "must be a PNG, TIFF, EXR, HDR or PFM image, got another format"},
    };
    for (const auto& [file, message] : rows) {
        const Outcome outcome =
            fixture.run({"compare", "a.png", file, "--diff", "out/difference.png"});
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(outcome.err == "raylane: " + file + ": " + message + "\n");
        CHECK(fixture.is_output_empty());
    }
}
