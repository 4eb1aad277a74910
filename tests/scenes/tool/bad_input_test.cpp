#include "scenes/images/reader.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/scenes/formats/nff/nff_scenes.hpp"
#include "tests/scenes/tool/tool_fixture.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sanitized.hpp"

#include <fstream>
#include <unistd.h>

using namespace raylane;
using namespace raylane::tests;

namespace {

struct Row {
    std::string name;
    std::string file;
    std::string content;
    std::string message; // follows the file's name
};

/// Checks that both commands that read scenes report the message in one line and write no file.
void check(const ToolFixture& fixture, const std::string& file, const std::string& message) {
    const std::string line = "raylane: " + file + ": " + message + "\n";
    for (const auto& arguments :
         {std::vector<std::string>{"render", file, "-o", "out/p.png", "--stats", "out/stats.json"},
          {"info", file},
          {"info", file, "--json"}}) {
        const Outcome outcome = fixture.run(arguments);
        CHECK(outcome.code == 2);
        CHECK(outcome.exited);
        CHECK(outcome.out.empty());
        CHECK(in_words(outcome.err) == line);
        CHECK(is_one_line(outcome.err));
    }
    CHECK(fixture.is_output_empty());
}

void check(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        INFO(row.name);
        const ToolFixture fixture;
        fixture.write(row.file, row.content);
        check(fixture, row.file, row.message);
    }
}

Row in_object(const std::string& name, const std::string& object, const std::string& message) {
    return {name, "a.json", with_objects(R"({"material": "clay", )" + object + "}"),
            "/objects/0" + message};
}

Row in_scene(const std::string& name, const std::string& member, const std::string& message) {
    return {name, "a.json",
            R"({"camera": {"from": [0, 0, 9], "at": [0, 0, 0]}, "objects": [], )" + member + "}",
            message};
}

Row in_camera(const std::string& name, const std::string& keys, const std::string& message) {
    return {name, "a.json", R"({"objects": [], "camera": {)" + keys + "}}", "/camera" + message};
}

Row in_nff(const std::string& name, const std::string& lines, const std::string& message) {
    return {name, "a.nff", view_and_light + lines, message};
}

} // namespace

TEST_CASE("a path without a scene file gives an error of one line") {
    const ToolFixture fixture;
    check(fixture, "none.json", "no such file");
    check(fixture, "none/a.nff", "no such file");
    check(fixture, "scene.json/a.json", "no such file");
    check(fixture, "out", "must be a file, got a directory");
    check(fixture, ".", "must be a file, got a directory");
    check({
        {"an empty JSON file", "a.json", "", "must be a scene or atoms, got an empty file"},
        {"an empty NFF file", "a.nff", "", "must be a scene or atoms, got an empty file"},
        {"an empty file", "a", "", "must be a scene or atoms, got an empty file"},
        {"JSON of nothing", "a.json", " // nothing\n", "must be a scene, got an empty file"},
        {"NFF of nothing", "a.nff", "# nothing\n", "must have a v entity, got none"},
        {"no scene at all", "a", "Dear Sir,\n",
         "must be a scene (.json, .nff, .pov, Tachyon .dat, or .rl from \"raylane build\") or "
         "atoms (.pdb, .pqr, mmCIF or CIF .cif, .xyz, .gro, .mol, .sdf, .mol2, LAMMPS .dump or "
         ".data), got another format"},
        {"no NFF at all", "a.nff", "Dear Sir,\n",
         R"(line 1: must be one of v, b, l, f, s, c, p and pp, got "Dear")"},
        {"a binary JSON file", "a.json",
         std::string("\x7F"
                     "ELF\0\1\2",
                     7),
         "must be a value, got \\x7FELF"},
        {"a binary file", "a", std::string("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16),
         "must be a scene or atoms in a text format, got a binary file"},
        {"a binary NFF file", "a.nff", "\x89PNG\r\n\x1A\n",
         R"(line 1: must be one of v, b, l, f, s, c, p and pp, got "\x89PNG")"},
    });
    // Control characters in a file's name do not add a line.
    fixture.write("a\n\x1B[31m.json", "[]");
    const Outcome outcome = fixture.run({"info", "a\n\x1B[31m.json"});
    CHECK(outcome.code == 2);
    CHECK(outcome.err == "raylane: a\\x0A\\x1B[31m.json:1:1: must be an object, got an array\n");
}

TEST_CASE("invalid JSON and JSON that is not a scene give an error of one line") {
    check({
        {"truncated", "a.json", "{\"camera\":\n  {\"from\": [0, 0",
         "must be ',' or ']', got the end of the file"},
        {"truncated behind a comma", "a.json", R"({"objects": [], )",
         "must be a key in double quotes, got the end of the file"},
        {"NaN", "a.json", "{\"background\":\n [0, NaN, 0]}", "must be a value, got NaN"},
        {"infinity", "a.json", "{\"background\":\n [0, Infinity, 0]}",
         "must be a value, got Infinity"},
        in_object("too large a number", R"("type": "sphere", "center": [0, 0, 0], "radius": 1e39)",
                  "/radius: must be a number from -1e30 to 1e30, got 1e+39"),
        in_scene("unknown key", R"("light": [])", R"(unknown key "light", did you mean "lights"?)"),
        in_object("unknown key in an object",
                  R"("type": "sphere", "center": [0, 0, 0], "raduis": 1)",
                  R"(: unknown key "raduis", did you mean "radius"?)"),
        in_object("missing key", R"("type": "sphere", "center": [0, 0, 0])",
                  R"(: must have the key "radius")"),
        {"missing objects", "a.json", R"({"camera": {"from": [0, 0, 9], "at": [0, 0, 0]}})",
         R"(must have the key "objects")"},
        in_object("wrong type", R"("type": "sphere", "center": [0, 0, 0], "radius": "1")",
                  R"(/radius: must be a number, got "1")"),
        in_object("too few numbers", R"("type": "sphere", "center": [0, 0], "radius": 1)",
                  "/center: must be an array of 3 numbers, got 2"),
        in_scene("unknown type", R"("lights": [{"type": "pint"}])",
                 R"(/lights/0/type: must be "point", "directional", "sky", "sphere", "disc", )"
                 R"("rectangle" or "camera", got "pint", )"
                 R"(did you mean "point"?)"),
    });
}

TEST_CASE("several mistakes in JSON give a line each") {
    const ToolFixture fixture;
    fixture.write("a.json", "{\"fog\": 3,\n \"camera\": 4}");
    const Outcome outcome = fixture.run({"info", "a.json"});
    CHECK(outcome.code == 2);
    CHECK(outcome.err == "raylane: a.json:1:1: must have the key \"objects\"\n"
                         "raylane: a.json:1:9: /fog: must be an object, got 3\n"
                         "raylane: a.json:2:12: /camera: must be an object, got 4\n");
}

TEST_CASE("an invalid shape gives an error of one line") {
    const std::string ball_at = R"("type": "sphere", "center": [0, 0, 0], )";
    check({
        in_object("radius 0", ball_at + R"("radius": 0)", "/radius: must be positive, got 0"),
        in_object("radius -0", ball_at + R"("radius": -0.0)", "/radius: must be positive, got -0"),
        in_object("negative radius", ball_at + R"("radius": -1)",
                  "/radius: must be positive, got -1"),
        in_object("no axis",
                  R"("type": "cylinder", "base": [0, 0, 0], "axis": [0, 0, 0], "radius": 1)",
                  "/axis: must not be the zero vector, got [0, 0, 0]"),
        in_object("no width",
                  R"("type": "cone", "base": [0, 0, 0], "axis": [0, 1, 0], )"
                  R"("base_radius": 0, "top_radius": 0)",
                  "/base_radius: must be positive if top_radius is 0, got 0"),
        in_object("degenerate triangle",
                  R"("type": "triangle", "a": [0, 0, 0], "b": [1, 1, 1], "c": [2, 2, 2])",
                  ": must have three corners that are not collinear, got [0, 0, 0], [1, 1, 1], [2, "
                  "2, 2]"),
        in_object("flat box",
                  R"("type": "box", "corner": [0, 0, 0], )"
                  R"("edges": [[1, 0, 0], [0, 1, 0], [1, 1, 0]])",
                  "/edges: must span a volume, got [1, 0, 0], [0, 1, 0], [1, 1, 0]"),
        in_object("empty box", R"("type": "box", "min": [0, 0, 0], "max": [1, 0, 1])",
                  "/max/1: must be more than min's 0, got 0"),
        {"unknown material", "a.json",
         with_objects(
             R"({"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "caly"})"),
         R"(/objects/0/material: must be the name of a material, got "caly", did you mean "clay"?)"},
        in_scene(
            "unknown pattern", R"("materials": {"a": {"pattern": {"type": "chekcer"}}})",
            R"(/materials/a/pattern/type: must be "checker", "stripes", "gradient", )"
            R"("formula", "image", "cutaway" or "back-plane", got "chekcer", did you mean "checker"?)"),
        in_scene(
            "mistake in a formula",
            R"~("materials": {"a": {"pattern": {"type": "formula", "color": ["x", "2 * sine(x)", "0"]}}})~",
            "/materials/a/pattern/color/1: must be a formula: line 1, column 5: expected x, y, "
            "z, u, v, pi, min, max, abs, floor, mod, sqrt, sin, cos, exp, log, noise, got "
            "\"sine\""),
        in_scene("index of refraction 0", R"("materials": {"a": {"index": 0}})",
                 "/materials/a/index: must be positive, got 0"),
    });
}

TEST_CASE("an invalid camera or fog or light or setting gives an error of one line") {
    check({
        in_camera("along up", R"("from": [0, 0, 1], "at": [0, 0, 0], "up": [0, 0, 2])",
                  "/up: must not be along the line of sight, got [0, 0, 2]"),
        in_camera("at its target", R"("from": [0, 0, 1], "at": [0, 0, 1])",
                  R"(/at: must differ from "from", got [0, 0, 1])"),
        in_camera("fov 0", R"("from": [0, 0, 1], "at": [0, 0, 0], "field_of_view": 0)",
                  "/field_of_view: must be between 0 and 180 degrees, both excluded, got 0"),
        in_camera("fov 180", R"("from": [0, 0, 1], "at": [0, 0, 0], "field_of_view": 180)",
                  "/field_of_view: must be between 0 and 180 degrees, both excluded, got 180"),
        in_scene("size 0", R"("image": {"width": 0})",
                 "/image/width: must be from 1 to 65535, got 0"),
        in_scene("absurd height", R"("image": {"height": 1000000})",
                 "/image/height: must be from 1 to 65535, got 1000000"),
        in_scene("absurd size", R"("image": {"width": 65535, "height": 65535})",
                 "/image/width: must make at most 268435456 pixels, got 65535 x 65535"),
        in_scene("no samples", R"("sampling": {"grid": 0})",
                 "/sampling/grid: must be from 1 to 256, got 0"),
        in_scene("fog planes equal", R"("fog": {"type": "linear-z", "start": 1, "end": 1})",
                 "/fog/end: must differ from start, got 1"),
        {"light on a surface", "a.json",
         with_objects(
             R"({"type": "sphere", "material": "clay", "center": [30, 30, 31], "radius": 1})"),
         "/lights/0/position: must not be on a surface, got a point of /objects/0"},
        {"no light", "a.json",
         R"({"camera": {"from": [0, 0, 9], "at": [0, 0, 0]}, "objects": [
            {"type": "sphere", "material": {}, "center": [0, 0, 0], "radius": 1}]})",
         "/lights: must have at least one light if there are objects, or be [] for no lights, got "
         "none"},
    });
}

TEST_CASE("a mistake in an NFF file gives an error of one line") {
    check({
        in_nff("unknown entity", "k 1 2 3\n",
               R"(line 9: must be one of v, b, l, f, s, c, p and pp, got "k")"),
        in_nff("not a number", "s 0 0 0 nan\n",
               R"(line 9: s: radius: must be a finite number, got "nan")"),
        in_nff("infinity", "s 0 inf 0 1\n",
               R"(line 9: s: center: must be a finite number, got "inf")"),
        in_nff("radius 0", "s 0 0 0 0\n", "line 9: s: radius: must be positive, got 0"),
        in_nff("too few fields", "s 0 0 0\ns 1 1 1 1\n",
               R"(line 10: s of line 9: radius: must be a finite number, got "s")"),
        in_nff("too many fields", "s 0 0 0 1 5\n",
               R"(line 9: must be the end of the line, got "5")"),
        in_nff("a vertex too few", "p 4\n0 0 0\n1 0 0\n1 1 0\ns 0 0 0 1\n",
               "line 13: p of line 9: vertex 4 of 4: position: must be a finite number, got "
               "\"s\""),
        in_nff("a vertex too many", "p 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n",
               R"(line 13: must be one of v, b, l, f, s, c, p and pp, got "0")"),
        in_nff("an absurd count", "p 4000000000\n0 0 0\n",
               "line 9: p: number of vertices: must be a whole number from 3 to 10000000, got "
               "\"4000000000\""),
        in_nff("a count that is not kept", "p 9999999\n0 0 0\n1 0 0\n",
               "line 11: p of line 9: vertex 3 of 9999999: position: must be a finite number, got "
               "the end of the file"),
        in_nff("axis 0", "c 0 0 0 1\n 0 0 0 1\n",
               "line 9: c: apex: must differ from the base, got the same point"),
        {"no light", "a.nff", view + "s 0 0 0 1\n",
         "lights: must have at least one light if there are objects, got none"},
    });
}

TEST_CASE("an NFF scene from a pipe is read once") {
    const ToolFixture fixture;
    const std::string scene = view_and_light + "s 0 0 0 1\ns 4 3 19 1\n";
    fixture.write("a.nff", scene);
    Setup from_pipe;
    from_pipe.in_child = [&] {
        int ends[2];
        if (::pipe(ends) != 0 || ::dup2(ends[0], STDIN_FILENO) < 0) return;
        static_cast<void>(::write(ends[1], scene.data(), scene.size()) < 0);
        ::close(ends[1]);
    };
    const Outcome outcome = fixture.run({"info", "/dev/stdin"}, from_pipe);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("/dev/stdin:8: l: a light on a surface is moved off it") !=
          std::string::npos);
}

TEST_CASE("a line of 200 MB gives an error in seconds and takes little memory") {
    constexpr std::uintmax_t size = 200'000'000;
    struct Long {
        std::string file, start;
        char filling;
        std::string message;
    };
    const std::vector<Long> rows = {
        {"a.nff", view_and_light + "p 9999999 ", '1',
         "line 9: must have words shorter than 256 bytes, got \"" + std::string(40, '1') + "...\""},
        {"a.nff", view_and_light, ' ', "line 9: must be a line shorter than 1048576 bytes"},
        {"a", "", '\0', "must be a scene or atoms in a text format, got a binary file"},
        {"a", "", ' ', "line 1: must be a line shorter than 1048576 bytes"},
        {"a.json", R"({"objects": [], "camera": )", '1',
         "must be a value of at most 1024 bytes, got " + std::string(40, '1') + "..."},
        {"a.json", R"({"objects": [], ")", 'a',
         "must be a string of at most 65536 bytes, got \"" + std::string(39, 'a') + "..."},
        {"a.json", "{", ' ', "must be a key in double quotes, got the end of the file"},
    };
    for (const Long& row : rows) {
        if (sanitized && row.file == "a.json" && row.filling == ' ') continue; // takes a minute
        const ToolFixture fixture;
        const std::filesystem::path path = fixture.write(row.file, row.start);
        if (row.filling != '\0') { // a file of zeros takes no disk space
            std::ofstream stream(path, std::ios::binary | std::ios::app);
            const std::string piece(1 << 20, row.filling);
            for (std::uintmax_t done = row.start.size(); done < size; done += piece.size())
                stream << piece;
        }
        std::filesystem::resize_file(path, size);
        const Outcome outcome = fixture.run({"render", row.file, "-o", "out/picture.png"});
        CHECK(outcome.code == 2);
        CHECK(in_words(outcome.err) == "raylane: " + row.file + ": " + row.message + "\n");
        if (!sanitized) CHECK(outcome.peak_memory < 64);
        CHECK(fixture.is_output_empty());
    }
}

TEST_CASE("a scene without objects renders the background") {
    const ToolFixture fixture(R"({"image": {"width": 3, "height": 2, "transfer": "linear"},
        "camera": {"from": [0, 0, 9], "at": [0, 0, 0]}, "background": [0.25, 0.5, 1], "objects": []})");
    const Outcome outcome = fixture.render("out/picture.pfm");
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("has no objects: the image shows only the background") !=
          std::string::npos);
    const scenes::Image image = scenes::read_image(fixture.output() / "picture.pfm");
    REQUIRE(image.width == 3);
    REQUIRE(image.height == 2);
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        CHECK(image.rgb[i] == 0.25F);
        CHECK(image.rgb[i + 1] == 0.5F);
        CHECK(image.rgb[i + 2] == 1.0F);
    }
}
