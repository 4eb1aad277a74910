#include "tests/places.hpp"
#include "tests/scenes/formats/json/json_scenes.hpp"
#include "tests/support/catch.hpp"

#include <vector>

using namespace raylane;
using namespace raylane::tests;
using core::Color;
using core::Vec3f;

namespace {

core::Camera camera_of(const std::string& camera) {
    return scene_of(R"({"camera": )" + camera + R"(, "objects": []})").camera();
}

core::Fog fog_of(const std::string& fog) {
    return scene_of(R"({"camera": {"from": [0, 0, 1], "at": [0, 0, 0]}, "objects": [], "fog": )" +
                    fog + "}")
        .fog();
}

core::Color background_of(const std::string& color) {
    return scene_of(
               R"({"camera": {"from": [0, 0, 1], "at": [0, 0, 0]}, "objects": [], "background": )" +
               color + "}")
        .background();
}

} // namespace

TEST_CASE("a scene with only a camera has defaults for everything else") {
    const core::Scene scene =
        scene_of(R"({"camera": {"from": [0, 0, 1], "at": [0, 0, 0]}, "objects": []})");
    CHECK(scene.shape_count() == 0);
    CHECK(scene.lights().empty());
    CHECK(scene.background() == Color(0.0F));
    CHECK(scene.fog().kind == core::FogKind::none);
    CHECK(scene.settings().width == 512);
    CHECK(scene.settings().height == 512);
    CHECK(scene.settings().grid == 1);
    CHECK(scene.settings().samples == core::SamplePattern::regular);
    CHECK(scene.settings().quality == 0.0F);
    CHECK(scene.settings().transfer == core::Transfer::srgb);
    CHECK(scene.settings().max_depth == 8);
    CHECK(scene.settings().min_weight == 0.001F);
    CHECK(scene.camera().projection == core::Projection::perspective);
    CHECK(scene.camera().up == Vec3f(0, 1, 0));
    CHECK(scene.camera().field_of_view == 45.0F);
}

TEST_CASE("the scene has every value of the root keys") {
    const core::Scene scene = scene_of(R"(
        // a comment before, with "quotes" and { braces
        {
            "$schema": "raylane-scene.schema.json", /* one
               over lines */
            "image": {"width": 300, "height": 2e2, "transfer": "linear"},
            "sampling": {"grid": 4.0, "pattern": "stratified", "quality": 38.5, "filter": "gaussian"},
            "limits": {"max_depth": 0, "min_weight": 0.25, "max_see_through": 3},
            "camera": {"type": "orthographic", "from": [1, 2, 3], "at": [4, 5, 6.5], "up": [0, 0, 2], "height": 3.5},
            "background": [0.1, 0.2, 0.3],
            "fog": {"type": "linear", "color": [1, 0.5, 0.25], "start": 1, "end": 9},
            "lights": [
                {"type": "point", "position": [1, 2, 3], "color": [2, 3, 4]},
                {"type": "directional", "direction": [0, -2, 0]} // "//" ends with the line
            ],
            "objects": []
        } /**/)");
    CHECK(scene.settings().width == 300);
    CHECK(scene.settings().height == 200);
    CHECK(scene.settings().transfer == core::Transfer::linear);
    CHECK(scene.settings().grid == 4);
    CHECK(scene.settings().samples == core::SamplePattern::stratified);
    CHECK(scene.settings().quality == 38.5F);
    CHECK(scene.settings().filter == core::PixelFilter::gaussian);
    CHECK(scene.settings().max_depth == 0);
    CHECK(scene.settings().max_transparent == 3); // by its former name
    CHECK(scene.settings().min_weight == 0.25F);
    CHECK(scene.camera().projection == core::Projection::orthographic);
    CHECK(scene.camera().from == Vec3f(1, 2, 3));
    CHECK(scene.camera().at == Vec3f(4, 5, 6.5F));
    CHECK(scene.camera().up == Vec3f(0, 0, 2));
    CHECK(scene.camera().height == 3.5F);
    CHECK(scene.background() == Color(0.1F, 0.2F, 0.3F));
    CHECK(scene.fog().kind == core::FogKind::linear);
    CHECK(scene.fog().color == Color(1, 0.5F, 0.25F));
    CHECK(scene.fog().start == 1.0F);
    CHECK(scene.fog().end == 9.0F);
    REQUIRE(scene.lights().size() == 2);
    CHECK(scene.lights()[0].kind == core::LightKind::point);
    CHECK(scene.lights()[0].position == Vec3f(1, 2, 3));
    CHECK(scene.lights()[0].color == Color(2, 3, 4));
    CHECK(scene.lights()[1].kind == core::LightKind::directional);
    CHECK(scene.lights()[1].direction == Vec3f(0, -2, 0));
    CHECK(scene.lights()[1].color == Color(1.0F));
}

TEST_CASE("cameras and fogs have their own keys") {
    CHECK(camera_of(R"({"from": [0, 0, 1], "at": [0, 0, 0], "field_of_view": 30})").field_of_view ==
          30.0F);
    CHECK(camera_of(R"({"type": "perspective", "from": [0, 0, 1], "at": [0, 0, 0]})").projection ==
          core::Projection::perspective);
    const core::Fog by_z = fog_of(R"({"type": "linear-z", "start": 5, "end": -5})");
    CHECK(by_z.kind == core::FogKind::linear_z);
    CHECK(by_z.start == 5.0F);
    CHECK(by_z.end == -5.0F);
    CHECK(by_z.color == Color(1.0F));
    const core::Fog exponential =
        fog_of(R"({"type": "exponential", "density": 0.125, "color": [0, 0, 1]})");
    CHECK(exponential.kind == core::FogKind::exponential);
    CHECK(exponential.density == 0.125F);
    CHECK(exponential.color == Color(0, 0, 1));
}

TEST_CASE("colours in hexadecimal are sRGB") {
    CHECK(background_of("\"#000000\"") == Color(0.0F));
    CHECK(background_of("\"#FFFFFF\"") == Color(1.0F));
    const Color color = background_of("\"#0aBc80\"");
    CHECK(color.x == static_cast<float>(10 / 255.0 / 12.92)); // on the straight part of the curve
    CHECK(color.y == Approx(0.5028865).epsilon(1e-6));
    CHECK(color.z == Approx(0.2158605).epsilon(1e-6));
}

TEST_CASE("materials may come behind the objects and objects keep their order") {
    const core::Scene scene = scene_of(R"({
        "objects": [
            {"type": "sphere", "material": "late", "center": [0, 0, 0], "radius": 1},
            {"type": "sphere", "material": {"diffuse": 0.25}, "center": [3, 0, 0], "radius": 2}],
        "lights": [{"type": "directional", "direction": [0, -1, 0]}],
        "materials": {"other": {}, "late": {"diffuse": 0.5}},
        "camera": {"from": [0, 0, 1], "at": [0, 0, 0]}})");
    REQUIRE(scene.shape_count() == 2);
    CHECK(shape<core::Sphere>(scene, 0).radius == 1.0);
    CHECK(scene.material_of(0).diffuse == 0.5F);
    CHECK(shape<core::Sphere>(scene, 1).radius == 2.0);
    CHECK(scene.material_of(1).diffuse == 0.25F);
}

TEST_CASE("generators are objects of a scene") {
    const core::Scene flake = scene_of(with_objects(
        R"({"type": "sphereflake", "material": "clay", "center": [1, 2, 3], "radius": 2, "depth": 2, "up": [0, 1, 0]})"));
    CHECK(flake.shape_count() == 91);
    CHECK(shape<core::Sphere>(flake, 0).center == core::Vec3d(1, 2, 3));

    const core::Scene lattice = scene_of(with_objects(
        R"({"type": "lattice", "material": "clay", "strut_material": "glass", "center": [1, 2, 3], "n": 3, "spacing": 0.5,
            "sphere_radius": 0.125, "strut_radius": 0.0625})"));
    CHECK(lattice.shape_count() == 81);
    CHECK(shape<core::Sphere>(lattice, 0).center == core::Vec3d(0.5, 1.5, 2.5));
    CHECK(lattice.material_of(26).transmission == 0.0F);
    CHECK(lattice.material_of(27).transmission == 1.0F);

    const core::Scene alike = scene_of(with_objects(
        R"({"type": "lattice", "material": "glass", "corner": [1, 2, 3], "n": 2, "spacing": 0.5, "sphere_radius": 0.125, "strut_radius": 0.0625})"));
    CHECK(shape<core::Sphere>(alike, 0).center == core::Vec3d(1, 2, 3));
    CHECK(alike.material_of(19).transmission == 1.0F);
}

TEST_CASE("a file may begin with a byte order mark and end without a line break") {
    CHECK(complaint_about_text("\xEF\xBB\xBF" + with_objects("")) == "");
    CHECK(complaint_about_text(with_objects("") + "\r\n// the end") == "");
}

TEST_CASE("scene examples of the pages parse") {
    const std::string readme = content_of(RAYLANE_SOURCE_DIR "/scenes/README.md");
    const std::string opening = "```json\n";
    const TemporaryDirectory directory;
    std::vector<std::size_t> shapes;
    for (std::size_t begin = 0; (begin = readme.find(opening, begin)) != std::string::npos;) {
        begin += opening.size();
        const std::string text = readme.substr(begin, readme.find("```", begin) - begin);
        scenes::InputFile file(directory.write("my.json", text));
        shapes.push_back(scenes::read_json(file).shape_count());
    }
    CHECK(shapes == std::vector<std::size_t>{2, 4, 3});
}
