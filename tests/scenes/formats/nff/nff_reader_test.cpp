#include "tests/places.hpp"
#include "tests/scenes/formats/nff/nff_scenes.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <map>
#include <numbers>

using namespace raylane;
using core::Visible;
using tests::scene_of;
using tests::view;
using tests::view_and_light;

namespace {

/// Returns the shapes of one kind by their id.
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
    CHECK(scene.settings().transfer == core::Transfer::linear);
    CHECK(scene.settings().max_depth == 4);
    CHECK(scene.settings().min_weight == 0.0F);
    // The angle is between the centres of 256 rows, 255 rows apart.
    const double half_angle = 22.5 * std::numbers::pi / 180.0;
    const double half_view = std::atan(std::tan(half_angle) * 256.0 / 255.0);
    CHECK(static_cast<double>(scene.camera().field_of_view) ==
          Approx(2.0 * half_view * 180.0 / std::numbers::pi).epsilon(1e-7));
}

TEST_CASE("an NFF view may have its parts in any order and on any lines and have one row") {
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

TEST_CASE("NFF spheres and cylinders and cones have the floats of the file") {
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

TEST_CASE("NFF polygons and patches become coplanar triangles") {
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
    for (const auto& [id, t] : smooth) { // both triangles have the reflex corner and its normal
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

TEST_CASE("NFF may have comments and blank lines and any line ends") {
    const std::string text = "# a comment\r\n\r\n   # another\n" + view +
                             "l 4 3 20 # colourless\n" + "\ts 0 0 0\t1 # 5\n\n\ns#c\n1#2\n1 1 1";
    const core::Scene scene = scene_of(text);
    const auto spheres = shapes_of<core::Sphere>(scene);
    REQUIRE(spheres.size() == 2);
    CHECK(spheres.at(0).radius == 1.0F);
    CHECK(spheres.at(1).center == core::Vec3f(1.0F));
}

TEST_CASE("NFF without objects is a scene without shapes") {
    CHECK(scene_of(view).shape_count() == 0);
    CHECK(scene_of(view_and_light).lights().size() == 1);
}

TEST_CASE("an NFF file is read correctly wherever its buffers end") {
    // Longer than the buffers, with buffers that end at every position of a word.
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

TEST_CASE("an NFF light on a surface moves off the surface") {
    raylane::scenes::InputFile file("a.nff",
                                    view + "l 5 5 5\nl 0 0 1\nf 1 1 1 1 0 0 0 1\ns 0 0 0 1\n");
    std::string remarks;
    const core::Scene scene =
        scenes::read_nff(file, nullptr, [&](const std::string& remark) { remarks += remark; });
    CHECK(remarks == "a.nff:9: l: a light on a surface is moved off it");
    CHECK(scene.lights().at(0).position == core::Vec3f(5, 5, 5));
    CHECK(core::length(scene.lights().at(1).position) == Approx(1.0F).epsilon(0.01));
    CHECK(core::length(scene.lights().at(1).position) > 1.0F);
}

TEST_CASE("the Standard Procedural Databases' scenes are read whole") {
    const std::filesystem::path scenes = RAYLANE_SHARED_SCENES;
    if (!std::filesystem::exists(scenes)) {
        WARN("skipped: shared scenes are missing");
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
