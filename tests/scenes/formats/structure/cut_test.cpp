#include "core/reference/surface_color.hpp"
#include "core/scene/transfer.hpp"
#include "scenes/files/errors.hpp"
#include "scenes/formats/scene_file.hpp"
#include "scenes/formats/structure/elements.hpp"
#include "simd/stream/stream_tracer.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/support/catch.hpp"

using namespace raylane;
using namespace raylane::scenes;

namespace {

const std::string atoms = "3\n\nHe 0 0 0\nHe 6 0 0\nHe 0 6 4\n";

core::Scene cut(const std::vector<std::string>& planes, float opacity = 1.0F) {
    LoadOptions options;
    options.drawing.style = Style::spheres;
    options.drawing.radius = "2";
    options.drawing.opacity = opacity;
    for (const std::string& plane : planes)
        options.drawing.cuts.push_back(cut_plane_of("--cut", plane));
    return parse_scene("a.xyz", atoms, options);
}

/// Returns the height of the first surface below z = 10, or -10 for a miss.
double height_at(const core::Scene& scene, double x, double y) {
    const double origin[3] = {x, y, 10.0}, direction[3] = {0.0, 0.0, -1.0};
    simd::RayStream<double> rays;
    rays.count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] = &origin[axis];
        rays.direction[axis] = &direction[axis];
    }
    core::ShapeId shape = core::no_shape;
    double t = 0.0;
    simd::HitStream hits;
    hits.shape = &shape;
    hits.t_double = &t;
    simd::StreamTracer(scene, 1).nearest(rays, hits);
    return shape == core::no_shape ? -10.0 : 10.0 - t;
}

} // namespace

TEST_CASE("a cut closes spheres by its plane exactly") {
    const core::Scene scene = cut({"z<1.25"});
    CHECK(height_at(scene, 0.0, 0.0) == 1.25);
    CHECK(height_at(scene, 6.25, 0.5) == 1.25);
    CHECK(height_at(scene, 0.0, 6.0) == -10.0);       // wholly on the other side
    CHECK(height_at(scene, 1.6, 0.0) == Approx(1.2)); // the rest of the sphere
    CHECK(scene.shape_count() == 3);                  // two spheres of a colour and their plane
    CHECK(cut({"z<7"}).solids().any() == false);
}

TEST_CASE("a face of a cut has the colours of the atoms around each point") {
    for (const std::string text : {"2\n\nHe 0 0 0\nNe 2 0 0\n", "2\n\nNe 2 0 0\nHe 0 0 0\n"}) {
        LoadOptions options;
        options.drawing.style = Style::spheres;
        options.drawing.radius = "1.5";
        options.drawing.cuts = {cut_plane_of("--cut", "z<0.25")};
        core::Scene scene = parse_scene("a.xyz", text, options);
        CHECK(scene.shape_count() == 3); // a plane for both
        const auto color = [&](double x) {
            const core::ShapeId plane = 2;
            const core::Solids::Node& node = scene.solids().node(scene.solids().part_of(plane));
            return core::color_on(scene, scene.material_of(plane).pattern,
                                  {plane, node.kind, node.place, core::body, {x, 0.0, 0.25}});
        };
        const auto of = [](Element number) {
            return core::convert<double>(core::color_from_srgb(data_of(number).color));
        };
        CHECK(color(0.99) == of(2));
        CHECK(color(1.01) == of(10));
    }
}

TEST_CASE("several cuts leave the part that all keep") {
    const core::Scene scene = cut({"z<=1", "x >= 0.5", "0,1,0,0.75"});
    CHECK(height_at(scene, 0.75, 0.0) == 1.0);
    CHECK(height_at(scene, 0.25, 0.0) == -10.0);
    CHECK(height_at(scene, 0.75, 1.0) == -10.0);
}

TEST_CASE("transparent atoms are cut as one solid") {
    CHECK(height_at(cut({"z<1.25"}, 0.5F), 0.0, 0.0) == 1.25);
}

TEST_CASE("transparent atoms that no plane cuts have no material for faces") {
    LoadOptions options;
    options.drawing.style = Style::spheres;
    options.drawing.opacity = 0.5F;
    const core::Scene scene = parse_scene("a.xyz", "2\n\nHe 0 0 0\nNe 2 0 0\n", options);
    CHECK(scene.materials().size() == 2);
}

TEST_CASE("a slab is across the view from the middle of the atoms") {
    LoadOptions options;
    options.drawing.style = Style::spheres;
    options.drawing.radius = "2";
    options.drawing.fit_camera.direction = {0.0F, 0.0F, -2.0F};
    options.drawing.slab = {{-1.0, 0.5}}; // the middle is at z = 2
    const core::Scene scene = parse_scene("a.xyz", atoms, options);
    CHECK(height_at(scene, 0.0, 0.0) == 2.0); // touches the slab from below
    CHECK(height_at(scene, 0.0, 6.0) == 2.5);
}

TEST_CASE("a cut may go through the middle of the atoms") {
    // Centres are from (0, 0, 0) to (6, 6, 4).
    const auto is_same = [](const char* plane, const char* same) {
        for (const double x : {-1.0, 0.5, 1.5, 5.0, 6.5})
            for (const double y : {0.0, 0.5, 6.0})
                if (height_at(cut({plane}), x, y) != height_at(cut({same}), x, y)) return false;
        return true;
    };
    CHECK(is_same("z<middle", "z<2"));
    CHECK(is_same("z <= middle + 1.5", "z<3.5"));
    CHECK(is_same("x>middle-2.5", "x>0.5"));
    CHECK(is_same("1,1,0,middle-5", "1,1,0,1"));
    CHECK(!is_same("z<middle", "z<2.5"));
}

TEST_CASE("cuts that leave nothing are refused by their names") {
    CHECK(tests::message_of<BadInput>([] { cut({"z<-3"}); }) ==
          "--cut: must leave a part of the atoms, got none: they have x from -2 to 8, y from -2 to "
          "8, z from -2 to 6");
    LoadOptions options;
    options.drawing.style = Style::spheres;
    options.drawing.radius = "2";
    options.drawing.fit_camera.direction = {0.0F, 0.0F, -2.0F};
    options.drawing.slab = {{50.0, 60.0}};
    options.drawing.show_cell = false;
    CHECK(tests::message_of<BadInput>([&] { parse_scene("a.xyz", atoms, options); }) ==
          "--slab: must leave a part of the atoms, got none: they have depths from -4 to 4");
}

TEST_CASE("a malformed cut is refused") {
    for (const std::string text :
         {"", "z", "w<1", "z<", "z<1,2", "1,2,3", "0,0,0,1", "z=1", "z<a", "z<middle1", "z<middle+",
          "z<middle*2", "1,2,middle,3", "middle"})
        CHECK_THROWS_AS(cut_plane_of("--cut", text), BadInput);
    for (const std::string text : {"", "1", "2 1", "1 1", "a b", "1:2:3"})
        CHECK_THROWS_AS(range_of("--slab", text), BadInput);
    for (const std::string text : {"-2:1", "-2 1", "-2,1"})
        CHECK(range_of("--slab", text) == std::pair(-2.0, 1.0));
}
