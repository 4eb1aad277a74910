#include "tests/scenes/formats/nff/nff_scenes.hpp"
#include "tests/support/catch.hpp"

#include <vector>

using namespace raylane::tests;

namespace {

struct Mistake {
    std::string text;
    std::string message;
};

} // namespace

TEST_CASE("each mistake in an NFF file gives an error of one line") {
    const std::string& v = view_and_light; // 8 lines
    const std::vector<Mistake> mistakes = {
        // Files that are not NFF
        {"", "must have a v entity, got none"},
        {"# nothing else\n", "must have a v entity, got none"},
        {"b 0 0 0\n", "must have a v entity, got none"},
        {"{\"objects\": []}",
         "line 1: must be one of v, b, l, f, s, c, p and pp, got \"{\"objects\":\""},
        {"\x89PNG\r\n\x1A\n",
         "line 1: must be one of v, b, l, f, s, c, p and pp, got \"\\x89PNG\""},
        {std::string(300, 'x'),
         "line 1: must have words shorter than 256 bytes, got \"" + std::string(40, 'x') + "...\""},
        {v + "k 1 2 3\n", "line 9: must be one of v, b, l, f, s, c, p and pp, got \"k\""},
        {"v near", // without a line feed: the word ends with the file
         "line 1: v: must continue with each of from, at, up, angle, hither, resolution, got "
         "\"near\""},
        // The view
        {"v\nfrom 0 0 8\nat 0 0 0\nup 0 1 0\nl 1 1 1\n",
         "line 5: v of line 1: must continue with each of angle, hither, resolution, got \"l\""},
        {"v from 0 0 8 from 0 0 7",
         "line 1: v: must continue with each of at, up, angle, hither, resolution, got \"from\""},
        {"\nv from 0 0\n", "line 2: v: from: must be a finite number, got the end of the file"},
        {"v from 0 0 8 at 0 0 8 up 0 1 0 angle 45 hither 1 resolution 4 4",
         "line 1: v: at: must differ from \"from\", got [0, 0, 8]"},
        {"v from 0 0 8 at 0 0 0 up 0 0 2 angle 45 hither 1 resolution 4 4",
         "line 1: v: up: must not be along the line of sight, got [0, 0, 2]"},
        {"v from 0 0 8 at 0 0 0 up 0 0 0 angle 45 hither 1 resolution 4 4",
         "line 1: v: up: must not be the zero vector, got [0, 0, 0]"},
        {"v from 0 0 8 at 0 0 0 up 0 1 0 angle 0 hither 1 resolution 4 4",
         "line 1: v: angle: must be between 0 and 180 degrees, both excluded, got 0"},
        {"v from 0 0 8 at 0 0 0 up 0 1 0 angle 180 hither 1 resolution 4 4",
         "line 1: v: angle: must be between 0 and 180 degrees, both excluded, got 180"},
        {"v from 0 0 8 at 0 0 0 up 0 1 0 angle -45 hither 1 resolution 4 4",
         "line 1: v: angle: must be between 0 and 180 degrees, both excluded, got -45"},
        {"v from 0 0 8 at 0 0 0 up 0 1 0 angle 45 hither near resolution 4 4",
         "line 1: v: hither: must be a finite number, got \"near\""},
        {"v from 0 0 8 at 0 0 0 up 0 1 0 angle 45 hither 1 resolution 0 4",
         "line 1: v: resolution: must be a whole number from 1 to 65535, got \"0\""},
        {"v from 0 0 8 at 0 0 0 up 0 1 0 angle 45 hither 1 resolution 4 65536",
         "line 1: v: resolution: must be a whole number from 1 to 65535, got \"65536\""},
        {"v from 0 0 8 at 0 0 0 up 0 1 0 angle 45 hither 1 resolution 4.5 4",
         "line 1: v: resolution: must be a whole number from 1 to 65535, got \"4.5\""},
        {"v from 0 0 8 at 0 0 0 up 0 1 0 angle 45 hither 1 resolution 4\nl 1 1 1",
         "line 2: v of line 1: resolution: must be a whole number from 1 to 65535, got \"l\""},
        {"v from 0 0 8 at 0 0 0 up 0 1 0 angle 45 hither 1 resolution 60000 60000",
         "line 1: v: width: must make at most 268435456 pixels, got 60000 x 60000"},
        // Background, lights and fills
        {v + "b 0 0 -1\n", "line 9: b: color/2: must not be negative, got -1"},
        {v + "l 1 2\n", "line 9: l: position: must be a finite number, got the end of the file"},
        {v + "l 1 2 3 1\n", "line 9: l: color: must be three numbers, got the end of the line"},
        {v + "l 1 2 3 1 1\n1\n",
         "line 9: l: color: must be three numbers, got the end of the line"},
        {v + "l 1 2 3 1 1 1 1\n", "line 9: must be the end of the line, got \"1\""},
        {v + "l 1 2 3 1 1 -0.5\n", "line 9: l: color/2: must not be negative, got -0.5"},
        {v + "l 1 2 2e30\n",
         "line 9: l: position/2: must be a number from -1e30 to 1e30, got 2e+30"},
        {v + "f 1 1 1 -1 0 1 0 1\n", "line 9: f: Kd: must not be negative, got -1"},
        {v + "f 1 1 1 1 -0.5 1 0 1\n", "line 9: f: Ks: must not be negative, got -0.5"},
        {v + "f 1 1 1 1 0 -1 0 1\n", "line 9: f: Shine: must not be negative, got -1"},
        {v + "f 1 1 1 1 0 1 1.5 1\n", "line 9: f: T: must be from 0 to 1, got 1.5"},
        {v + "f 1 1 1 1 0 1 -1 1\n", "line 9: f: T: must be from 0 to 1, got -1"},
        {v + "f 1 1 1 1 0 1 0.5 0\n", "line 9: f: index of refraction: must be positive, got 0"},
        {v + "f 1 1 1 1 0 1 0 -1\n", "line 9: f: index of refraction: must be positive, got -1"},
        {v + "f 1 -1 1 1 0 1 0 1\n", "line 9: f: color/1: must not be negative, got -1"},
        {v + "f 1 1 1 1 0 1 0\ns 0 0 0 1\n",
         "line 10: f of line 9: index of refraction: must be a finite number, got \"s\""},
        {v + "f 1 1 1 2e30 0 1 0 1\n", "line 9: f: ambient: must be at most 1e10, got 2e+30"},
        // Spheres
        {v + "s 0 0 0 0\n", "line 9: s: radius: must be positive, got 0"},
        {v + "s 0 0 0 nan\n", "line 9: s: radius: must be a finite number, got \"nan\""},
        {v + "s 0 0 0 inf\n", "line 9: s: radius: must be a finite number, got \"inf\""},
        {v + "s 0 -infinity 0 1\n",
         "line 9: s: center: must be a finite number, got \"-infinity\""},
        {v + "s 0 0 1e39 1\n",
         "line 9: s: center: must be a number from -1e30 to 1e30, got \"1e39\""},
        {v + "s 0 0 1e400 1\n",
         "line 9: s: center: must be a number from -1e30 to 1e30, got \"1e400\""},
        {v + "s 0 0 0 1e-60\n",
         "line 9: s: radius: must be positive, got 0, the float nearest to 1e-60"},
        {v + "s 0 0 1e38 1\n",
         "line 9: s: center/2: must be a number from -1e30 to 1e30, got 1e+38"},
        {v + "s 0 0 0x10 1\n", "line 9: s: center: must be a finite number, got \"0x10\""},
        {v + "s 0 0 1,5 1\n", "line 9: s: center: must be a finite number, got \"1,5\""},
        {v + "s 0 0 0 1 5\n", "line 9: must be the end of the line, got \"5\""},
        {v + "s 0 0 0 1 s 0 0 0 2\n", "line 9: must be the end of the line, got \"s\""},
        {v + "s 0 0 0\ns 1 1 1 1\n",
         "line 10: s of line 9: radius: must be a finite number, got \"s\""},
        {v + "s 0 0 0\n", "line 9: s: radius: must be a finite number, got the end of the file"},
        // Cylinders and cones
        {v + "c 0 0 0 1\n 0 0 0 1\n",
         "line 9: c: apex: must differ from the base, got the same point"},
        {v + "c 0 0 0 1\n 0 0 1 -1\n",
         "line 9: c: radii: must not be of different signs, got 1 and -1"},
        {v + "c 0 0 0 0\n 0 0 1 0\n", "line 9: c: radius: must be positive, got 0"},
        {v + "c 0 0 0 1\n 0 0 1\nc 0 0 0 1 0 0 1 1\n",
         "line 11: c of line 9: apex radius: must be a finite number, got \"c\""},
        // Polygons
        {v + "p 2\n0 0 0\n1 0 0\n",
         "line 9: p: number of vertices: must be a whole number from 3 to 10000000, got \"2\""},
        {v + "p -3\n",
         "line 9: p: number of vertices: must be a whole number from 3 to 10000000, got \"-3\""},
        {v + "p 4000000000\n0 0 0\n", "line 9: p: number of vertices: must be a whole number from "
                                      "3 to 10000000, got \"4000000000\""},
        {v + "p 3.0\n",
         "line 9: p: number of vertices: must be a whole number from 3 to 10000000, got \"3.0\""},
        {v + "p\n", "line 9: p: number of vertices: must be a whole number from 3 to 10000000, got "
                    "the end of the file"},
        {v + "p 4\n0 0 0\n1 0 0\n1 1 0\ns 0 0 0 1\n",
         "line 13: p of line 9: vertex 4 of 4: position: must be a finite number, got \"s\""},
        {v + "p 9999999\n0 0 0\n1 0 0\n", "line 11: p of line 9: vertex 3 of 9999999: position: "
                                          "must be a finite number, got the end of the file"},
        {v + "p 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n",
         "line 13: must be one of v, b, l, f, s, c, p and pp, got \"0\""},
        {v + "p 3\n0 0 0\n1 0 0\n1 1 0 0\n", "line 12: must be the end of the line, got \"0\""},
        {v + "p 3\n0 0 0\n1 1 1\n2 2 2\n",
         "line 9: p: must have an area, got 3 vertices without one"},
        {v + "p 4\n5 5 5\n5 5 5\n5 5 5\n5 5 5\n",
         "line 9: p: must have an area, got 4 vertices without one"},
        {v + "p 3\n0 0 0\n1 0 0\n0 3e30 0\n", "line 12: p of line 9: vertex 3 of 3: position: must "
                                              "be numbers from -1e30 to 1e30, got 3e+30"},
        {v + "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 0\n1 1 0 0 0 1\n",
         "line 11: pp of line 9: vertex 2 of 3: normal: must not be the zero vector, got 0 0 0"},
        {v + "pp 3\n0 0 0 0 0 1\n1 0 0\n", "line 11: pp of line 9: vertex 2 of 3: normal: must be "
                                           "a finite number, got the end of the file"},
        // Order
        {"s 0 0 0 1\n" + v, "line 1: s: must come after the v entity, got it before"},
        {v + "p 3 0 0 0 1 0 0 0 1 0\n" + view,
         "line 10: v: must come before the objects, got it after them"},
        {v + "s 0 0 0 1\nl 1 2 3\n", "line 10: l: must come before the objects, got it after them"},
        // The whole scene
        {view + "s 0 0 0 1\n",
         "lights: must have at least one light if there are objects, got none"},
    };
    for (const auto& [text, message] : mistakes) {
        CAPTURE(text);
        CHECK(error_of(text) == "scene.nff: " + message);
    }
}

TEST_CASE("a line that is too long gives an error and is not kept in memory") {
    // Numbers of an endless polygon, blanks, a comment, and one word.
    const std::string polygon = view_and_light + "p 9999999 ";
    std::string numbers;
    while (numbers.size() < 2 << 20)
        numbers += "1 2 3 ";
    CHECK(error_of(polygon + numbers) ==
          "scene.nff: line 9: must be a line shorter than 1048576 bytes");
    CHECK(error_of(view_and_light + std::string(2 << 20, ' ')) ==
          "scene.nff: line 9: must be a line shorter than 1048576 bytes");
    CHECK(error_of(view + std::string(2 << 20, '#') + "\n") ==
          "scene.nff: line 8: must be a line shorter than 1048576 bytes");
    CHECK(
        error_of(std::string(2 << 20, '\0'))
            .starts_with("scene.nff: line 1: must have words shorter than 256 bytes, got \"\\x00"));
    // A line of one byte less is accepted, wherever the buffer ends.
    std::string comment(1 << 20, 'x');
    comment[0] = '#';
    CHECK(error_of(comment + "\n" + view) ==
          "scene.nff: line 1: must be a line shorter than 1048576 bytes");
    comment.pop_back();
    CHECK(error_of(comment + "\n" + view) == "no error");
    CHECK(error_of(view + comment + "\n" + comment) == "no error");
}
