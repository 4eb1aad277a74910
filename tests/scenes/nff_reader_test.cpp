#include "scenes/errors.hpp"
#include "scenes/nff_reader.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/temporary_directory.hpp"

#include <cmath>
#include <map>
#include <numbers>

using namespace raylane;
using core::Visible;

namespace {

const std::string view = "v\n"
                         "from 0 0 8\n"
                         "at 0 0 0\n"
                         "up 0 1 0\n"
                         "angle 45\n"
                         "hither 1\n"
                         "resolution 512 256\n";
const std::string view_and_light = view + "l 4 3 20\n"; // 8 lines

core::Scene scene_of(std::string_view text) {
    const tests::TemporaryDirectory directory;
    scenes::InputFile file(directory.write("scene.nff", text));
    return scenes::read_nff(file);
}

/// The message without the file's directory.
std::string error_of(std::string_view text) {
    const tests::TemporaryDirectory directory;
    scenes::InputFile file(directory.write("scene.nff", text));
    try {
        scenes::read_nff(file);
    } catch (const scenes::BadInput& error) {
        return std::string(error.what()).substr(directory.path().string().size() + 1);
    }
    return "no error";
}

/// The shapes of one kind by their id.
template <class Shape>
std::map<core::ShapeId, Shape> shapes_of(const core::Scene& scene) {
    std::map<core::ShapeId, Shape> shapes;
    for (const auto& block : std::get<core::Table<Shape>>(scene.shapes()).blocks())
        for (int lane = 0; lane < core::block_size; ++lane)
            if (block.ids[lane] != core::no_shape) shapes[block.ids[lane]] = block.get(lane);
    return shapes;
}

} // namespace

TEST_CASE("an NFF view becomes the camera") {
    const core::Scene scene = scene_of("b 0.1 0.2 0.3\n" + view_and_light);
    CHECK(scene.background() == core::Color(0.1F, 0.2F, 0.3F));
    CHECK(scene.camera().projection == core::Projection::perspective);
    CHECK(scene.camera().from == core::Vec3f(0, 0, 8));
    CHECK(scene.camera().at == core::Vec3f(0, 0, 0));
    CHECK(scene.camera().up == core::Vec3f(0, 1, 0));
    CHECK(scene.settings().width == 512);
    CHECK(scene.settings().height == 256);
    // The angle is between the centres of 256 rows, 255 rows apart.
    const double half_angle = 22.5 * std::numbers::pi / 180.0;
    const double half_view = std::atan(std::tan(half_angle) * 256.0 / 255.0);
    CHECK(static_cast<double>(scene.camera().field_of_view) ==
          Approx(2.0 * half_view * 180.0 / std::numbers::pi).epsilon(1e-7));
}

TEST_CASE("an NFF view may have its parts in any order and on any lines, and one row") {
    const core::Scene scene = scene_of("v resolution 3 1 angle\n45 up 0 0 1 # comment\n"
                                       "hither\n\n0.5 at 0 1 0 from\n 0 -5 0 # end\nl 0 0 9");
    CHECK(scene.camera().field_of_view == 45.0F);
    CHECK(scene.camera().from == core::Vec3f(0, -5, 0));
    CHECK(scene.background() == core::Color(0.0F));
}

TEST_CASE("the last NFF view and background count") {
    const core::Scene scene = scene_of("b 1 1 1\n" + view + view_and_light + "b 0 1 0\n");
    CHECK(scene.background() == core::Color(0, 1, 0));
}

TEST_CASE("NFF lights without a colour share the intensity that the Readme proposes") {
    const core::Scene scene =
        scene_of(view + "l 1 2 3\nl 4 5 6 0.1 0.2 0.3\nl 7 8 9 # no colour\nl 0\n0 20\n");
    REQUIRE(scene.lights().size() == 4);
    CHECK(scene.lights()[0].kind == core::LightKind::point);
    CHECK(scene.lights()[0].position == core::Vec3f(1, 2, 3));
    CHECK(scene.lights()[0].color == core::Color(0.25F));
    CHECK(scene.lights()[1].color == core::Color(0.1F, 0.2F, 0.3F));
    CHECK(scene.lights()[2].color == core::Color(0.25F));
    CHECK(scene.lights()[3].position == core::Vec3f(0, 0, 20));
}

TEST_CASE("an NFF fill becomes a material") {
    const core::Scene scene = scene_of(view + "l 9 9 9\nl 9 9 8\n"
                                              "s 9 0 0 1\n"
                                              "f 1 0.5 0.25 0.8 0.2 30 0 0\n"
                                              "s 0 0 0 1\n"
                                              "f 0 0 1 0.1 0.25 5 0.6 1.5\n"
                                              "s 3 0 0 1\n"
                                              "f 0 0 1 1.5 2 5 1 1.5\n"
                                              "s 6 0 0 1\n"
                                              "f 1 0.5 0.25 0.8 0.2 30 0 0\n"
                                              "s 0 5 0 1\n");
    const auto intensity = static_cast<float>(std::sqrt(2.0) / 4.0);

    const core::Material& usual = scene.material_of(0);
    CHECK(usual.pattern.colors[0] == core::Color(0.5F));
    CHECK(usual.diffuse == 1.0F);
    CHECK_FALSE(usual.reflects());
    CHECK_FALSE(usual.transmits());

    const core::Material& opaque = scene.material_of(1);
    CHECK(opaque.pattern.kind == core::PatternKind::solid);
    CHECK(opaque.pattern.colors[0] == core::Color(1.0F, 0.5F, 0.25F));
    CHECK(opaque.ambient == intensity * 0.8F);
    CHECK(opaque.diffuse == 0.8F);
    CHECK(opaque.specular == 0.2F);
    CHECK(opaque.exponent == 30.0F);
    CHECK(opaque.reflection == core::Reflection::constant);
    CHECK(opaque.reflectivity == 0.2F);
    CHECK(opaque.transmission == 0.0F);
    CHECK(opaque.index == 1.0F);
    CHECK(opaque.visible == Visible::both);

    const core::Material& glass = scene.material_of(2);
    CHECK(glass.transmission == 0.6F / 0.75F);
    CHECK(glass.index == 1.5F);

    const core::Material& mirror = scene.material_of(3);
    CHECK(mirror.diffuse == 1.5F);
    CHECK(mirror.specular == 2.0F);
    CHECK(mirror.reflectivity == 1.0F);
    CHECK(mirror.transmission == 0.0F);

    CHECK(scene.material_index_of(4) == scene.material_index_of(1));
}

TEST_CASE("NFF spheres, cylinders and cones are their floats") {
    const core::Scene scene = scene_of(view_and_light + "f 1 1 1 1 0 1 0 1\n"
                                                        "s 0.1 -2.55836e-17 +3 .5\n"
                                                        "s 1 2 3 -0.25\n"
                                                        "c 0.1 0.2 0.3 0.5 1.1 2.2 3.3 0.5\n"
                                                        "c 0 0 0 -0.5\n 0 0 1 -0.5\n"
                                                        "c 0 0 0 0.5\n\n 0 0 1 0.25\n"
                                                        "c 0 0 0 -0.25 0 0 1 -0.5\n"
                                                        "c 0 0 0 0.5 0 0 1 0\n"
                                                        "c 0 0 0 -0.5 0 0 1 0#comment\n"
                                                        "s 0 0 0 -1\n");
    CHECK(scene.shape_count() == 9);
    const auto spheres = shapes_of<core::Sphere>(scene);
    REQUIRE(spheres.size() == 3);
    CHECK(spheres.at(0).center == core::Vec3f(0.1F, -2.55836e-17F, 3.0F));
    CHECK(spheres.at(0).radius == 0.5F);
    CHECK(spheres.at(1).radius == 0.25F);

    const auto cylinders = shapes_of<core::OpenCylinder>(scene);
    REQUIRE(cylinders.size() == 2);
    CHECK(cylinders.at(2).base == core::Vec3f(0.1F, 0.2F, 0.3F));
    CHECK(cylinders.at(2).axis == core::Vec3f(1.1F - 0.1F, 2.2F - 0.2F, 3.3F - 0.3F));
    CHECK(cylinders.at(2).radius == 0.5F);
    CHECK(cylinders.at(3).radius == 0.5F);

    const auto cones = shapes_of<core::OpenCone>(scene);
    REQUIRE(cones.size() == 4);
    CHECK(cones.at(4).base_radius == 0.5F);
    CHECK(cones.at(4).top_radius == 0.25F);
    CHECK(cones.at(5).base_radius == 0.25F);
    CHECK(cones.at(5).top_radius == 0.5F);
    CHECK(cones.at(6).top_radius == 0.0F);
    CHECK(cones.at(7).base_radius == 0.5F);

    for (const core::ShapeId id : {0U, 2U, 4U, 6U})
        CHECK(scene.material_of(id).visible == Visible::both);
    for (const core::ShapeId id : {1U, 3U, 5U, 7U})
        CHECK(scene.material_of(id).visible == Visible::inside);
    CHECK(scene.material_index_of(8) == scene.material_index_of(1));
    CHECK(scene.materials().size() == 2);
}

TEST_CASE("NFF polygons and patches are flat sets of triangles") {
    const core::Scene scene = scene_of(view_and_light + "p 3\n0 0 0\n1 0 0\n0 1 0\n"
                                                        "p 4 0 0 5 1 0 5 1 1 5 0 1 5\n"
                                                        "pp 4\n"
                                                        "0 0 0 0 0 1\n"
                                                        "2 0 0 0 0.1 1\n"
                                                        "0.5 0.5 0 0 0.2 1\n"
                                                        "0 2 0 0 0.3 1\n");
    const auto triangles = shapes_of<core::Triangle>(scene);
    REQUIRE(triangles.size() == 3);
    const core::Vec3f normal =
        core::cross(triangles.at(0).b - triangles.at(0).a, triangles.at(0).c - triangles.at(0).a);
    CHECK(normal == core::Vec3f(0, 0, 1));
    CHECK(scene.coplanar_with(0).last == 0);
    CHECK(scene.coplanar_with(1).first == 1);
    CHECK(scene.coplanar_with(1).last == 2);

    const auto smooth = shapes_of<core::SmoothTriangle>(scene);
    REQUIRE(smooth.size() == 2);
    CHECK(scene.coplanar_with(3).last == 4);
    for (const auto& [id, t] : smooth) { // each corner with its normal, the reflex one in both
        int reflex_corners = 0;
        const core::Vec3f corners[3] = {t.a, t.b, t.c};
        const core::Vec3f normals[3] = {t.normal_a, t.normal_b, t.normal_c};
        for (int i = 0; i < 3; ++i) {
            if (corners[i] != core::Vec3f(0.5F, 0.5F, 0.0F)) continue;
            ++reflex_corners;
            CHECK(normals[i] == core::Vec3f(0.0F, 0.2F, 1.0F));
        }
        CHECK(reflex_corners == 1);
    }
}

TEST_CASE("NFF may have comments, blank lines and any line ends") {
    const std::string text = "# a comment\r\n\r\n   # another\n" + view +
                             "l 4 3 20 # colourless\n" + "\ts 0 0 0\t1 # 5\n\n\ns#c\n1#2\n1 1 1";
    const core::Scene scene = scene_of(text);
    const auto spheres = shapes_of<core::Sphere>(scene);
    REQUIRE(spheres.size() == 2);
    CHECK(spheres.at(0).radius == 1.0F);
    CHECK(spheres.at(1).center == core::Vec3f(1.0F));
}

TEST_CASE("NFF without objects is a picture of the background") {
    CHECK(scene_of(view).shape_count() == 0);
    CHECK(scene_of(view_and_light).lights().size() == 1);
}

TEST_CASE("an NFF file is the same whatever parts it is read in") {
    // Longer than the buffers are, and words at every place of their ends.
    std::string text = view_and_light;
    std::vector<float> radii;
    for (int i = 0; i < 100000; ++i) {
        radii.push_back(1.0F + static_cast<float>(i) / 64.0F);
        text += "s " + std::to_string(i % 1000) + " 0 -900 " + std::to_string(radii.back());
        text += i % 3 == 0 ? "\n" : " # some words to be passed over\n\n";
    }
    REQUIRE(text.size() > 3 << 20);
    const auto spheres = shapes_of<core::Sphere>(scene_of(text));
    REQUIRE(spheres.size() == radii.size());
    bool same = true;
    for (const auto& [id, sphere] : spheres)
        same = same && sphere.radius == radii[id] &&
               sphere.center == core::Vec3f(static_cast<float>(id % 1000), 0.0F, -900.0F);
    CHECK(same);
}

namespace {

struct Mistake {
    std::string text;
    std::string message;
};

} // namespace

TEST_CASE("each mistake in an NFF file has its line of error") {
    const std::string& v = view_and_light; // 8 lines
    const std::vector<Mistake> mistakes = {
        // What is not an NFF file
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
        // The view
        {"v\nfrom 0 0 8\nat 0 0 0\nup 0 1 0\nl 1 1 1\n",
         "line 5: v of line 1: must go on with each of angle, hither, resolution, got \"l\""},
        {"v from 0 0 8 from 0 0 7",
         "line 1: v: must go on with each of at, up, angle, hither, resolution, got \"from\""},
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
        {v + "f 1 1 1 2e30 0 1 0 1\n",
         "line 9: f: ambient: must be a number from -1e30 to 1e30, got 2e+30"},
        // Spheres
        {v + "s 0 0 0 0\n", "line 9: s: radius: must be positive, got 0"},
        {v + "s 0 0 0 nan\n", "line 9: s: radius: must be a finite number, got \"nan\""},
        {v + "s 0 0 0 inf\n", "line 9: s: radius: must be a finite number, got \"inf\""},
        {v + "s 0 -infinity 0 1\n",
         "line 9: s: center: must be a finite number, got \"-infinity\""},
        {v + "s 0 0 1e39 1\n", "line 9: s: center: must be a finite number, got \"1e39\""},
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
        // The order
        {"s 0 0 0 1\n" + v, "line 1: s: must come after the v entity, got it before"},
        {v + "p 3 0 0 0 1 0 0 0 1 0\n" + view,
         "line 10: v: must come before the objects, got it after them"},
        {v + "s 0 0 0 1\nl 1 2 3\n", "line 10: l: must come before the objects, got it after them"},
        // What only the whole scene shows
        {view + "s 0 0 0 1\n",
         "lights: must have at least one light where there are objects, got none"},
        {view + "l 5 5 5\nl 0 0 1\ns 0 0 0 1\n",
         "line 9: l: position: must not be on a surface, got a point of shape 0"},
    };
    for (const auto& [text, message] : mistakes) {
        CAPTURE(text);
        CHECK(error_of(text) == "scene.nff: " + message);
    }
}

TEST_CASE("a long line ends in a line of error, and not in memory") {
    // Words that would be read on and on, blanks, a comment, and one word.
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
    // One byte less is none too many, wherever the buffer ends.
    std::string comment(1 << 20, 'x');
    comment[0] = '#';
    CHECK(error_of(comment + "\n" + view) ==
          "scene.nff: line 1: must be a line shorter than 1048576 bytes");
    comment.pop_back();
    CHECK(error_of(comment + "\n" + view) == "no error");
    CHECK(error_of(view + comment + "\n" + comment) == "no error");
}

TEST_CASE("the Standard Procedural Databases' scenes are read whole") {
    const std::filesystem::path scenes = RAYLANE_SHARED_SCENES;
    if (!std::filesystem::exists(scenes)) {
        WARN("skipped: there are no shared scenes here");
        return;
    }
    const auto read = [&](const char* name) {
        raylane::scenes::InputFile file(scenes / name);
        return scenes::read_nff(file);
    };
    const core::Scene balls = read("balls.nff");
    CHECK(shapes_of<core::Sphere>(balls).size() == 7381);
    CHECK(shapes_of<core::Triangle>(balls).size() == 2);
    CHECK(balls.shape_count() == 7383);
    CHECK(balls.lights().size() == 3);
    CHECK(balls.materials().size() == 2);
    CHECK(balls.background() == core::Color(0.078F, 0.361F, 0.753F));

    const core::Scene rings = read("rings.nff");
    CHECK(shapes_of<core::Sphere>(rings).size() == 4200);
    CHECK(shapes_of<core::OpenCylinder>(rings).size() == 4200);
    CHECK(shapes_of<core::Triangle>(rings).size() == 2);
    CHECK(rings.shape_count() == 8402);

    const core::Scene tree = read("tree.nff");
    CHECK(shapes_of<core::Sphere>(tree).size() == 4095);
    CHECK(shapes_of<core::OpenCone>(tree).size() == 4095);
    CHECK(shapes_of<core::Triangle>(tree).size() == 2);
    CHECK(tree.lights().size() == 7);
}
