#include "core/scene/scene.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <numbers>
#include <string>

using namespace raylane::core;

namespace {

/// Returns two balls side by side, an infinite floor, and a camera.
SceneBuilder some_balls() {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    builder.add(Sphere{{-3, 0, 1}, 1}, material);
    builder.add(Sphere{{4, 1, -2}, 0.5F}, material);
    builder.add(Plane{{0, -100, 0}, {0, 1, 0}}, material);
    builder.camera = {.from = {0, 2, 20}, .at = {0, 0, 0}};
    builder.settings.width = 300;
    builder.settings.height = 200;
    return builder;
}

Scene staged_balls(const AutoCamera& auto_camera) {
    SceneBuilder builder = some_balls();
    builder.auto_camera = auto_camera;
    if (!auto_camera.lights) builder.add_light({.position = {0, 50, 0}});
    return std::move(builder).build();
}

/// Returns how far a ball reaches towards the edges of a perspective image: 1 is at an edge.
double reach_of(const Camera& camera, double aspect, const Vec3d& center, double radius) {
    const Vec3d from = convert<double>(camera.from), to = convert<double>(camera.at) - from;
    const Vec3d forward = 1.0 / length(to) * to;
    const Vec3d across = cross(forward, convert<double>(camera.up));
    const Vec3d right = 1.0 / length(across) * across, up = cross(right, forward);
    const Vec3d w = center - from;
    const double depth = dot(w, forward);
    CHECK(depth > radius);
    const double slope =
        std::tan(static_cast<double>(camera.field_of_view) * std::numbers::pi / 360.0);
    const auto reach = [&](double place, double half) {
        const double angle =
            std::atan2(std::abs(place), depth) + std::asin(radius / std::hypot(place, depth));
        return std::tan(angle) / half;
    };
    return std::max(reach(dot(w, right), aspect * slope), reach(dot(w, up), slope));
}

double reach_of_balls(const Camera& camera) {
    return std::max(reach_of(camera, 1.5, {-3, 0, 1}, 1.0), reach_of(camera, 1.5, {4, 1, -2}, 0.5));
}

bool same(const Vec3f& a, const Vec3f& b) {
    return length(convert<double>(a) - convert<double>(b)) < 1e-5;
}

} // namespace

TEST_CASE("a camera that finds its place sees all bounded shapes and little more") {
    const Scene scene = staged_balls({.fit_camera = FitCamera{.direction = {-1, -1, -1}}});
    CHECK(reach_of_balls(scene.camera()) < 1.0);
    CHECK(reach_of_balls(scene.camera()) > 0.9);
    CHECK(scene.lights().size() == 1);
    CHECK(scene.fog().kind == FogKind::none);
}

TEST_CASE("a camera that has nothing to find its place by is refused") {
    SceneBuilder builder;
    builder.add(Plane{{0, 0, 0}, {0, 1, 0}}, builder.add_material({}));
    builder.auto_camera = {.fit_camera = FitCamera{}, .lights = true};
    try {
        static_cast<void>(std::move(builder).build());
        FAIL("it was taken");
    } catch (const InvalidValue& invalid) {
        CHECK(invalid.field == "camera");
        CHECK(invalid.expectation.find("must have a bounded shape to frame") != std::string::npos);
    }
}

TEST_CASE("a camera brings lights and a depth cue to a scene without lights") {
    const Scene scene =
        staged_balls({.fit_camera = FitCamera{}, .lights = true, .depth_cue = 0.5F});
    CHECK(scene.own_light_count() == 0);
    REQUIRE(scene.lights().size() == 2);
    CHECK(scene.lights()[0].kind == LightKind::sky);
    CHECK(scene.lights()[1].kind == LightKind::sphere);
    CHECK(scene.fog().kind == FogKind::linear);
    CHECK(scene.fog().start > 0.0F);
    CHECK(scene.fog().end > scene.fog().start);
    // A camera with a given place brings the same lights.
    const Scene own = staged_balls({.fit_camera = std::nullopt, .lights = true});
    CHECK(own.lights().size() == 2);
    CHECK(same(own.camera().from, {0, 2, 20}));
}

TEST_CASE("an orbiting camera keeps its target and height and sees all balls") {
    const AutoCamera auto_camera{
        .fit_camera = FitCamera{.direction = {-1, -1, -1}}, .lights = true, .turning = true};
    const Scene scene = staged_balls(auto_camera);
    const View view{scene.camera(), scene.fog(), scene.lights()};
    const Vec3f up = {0, 1, 0};
    for (const double degrees : {0.0, 37.0, 90.0, 180.0, 271.5, -45.0, 720.0}) {
        const View other = turned(view, up, degrees);
        INFO(degrees);
        CHECK(same(other.camera.at, view.camera.at));
        CHECK(std::abs(other.camera.from.y - view.camera.from.y) < 1e-4F);
        CHECK(reach_of_balls(other.camera) < 1.0);
        CHECK(same(other.lights[1].position, view.lights[1].position) ==
              same(other.camera.from, view.camera.from));
    }
    CHECK(same(turned(view, up, 360.0).camera.from, view.camera.from));
    // It turns to its right: from the front it comes to the right side.
    const View front{{.from = {0, 0, 5}, .at = {0, 0, 0}}, {}, {}};
    CHECK(same(turned(front, up, 90.0).camera.from, {5, 0, 0}));
    CHECK(same(turned(front, {0, 3, 0}, 180.0).camera.from, {0, 0, -5}));
}

TEST_CASE("a cut union is as wide in the frame as its parts") {
    const FitCamera tilted{.direction = {-1, -1, -1}};
    const auto frame_of = [&](bool is_cut) {
        SceneBuilder builder;
        const MaterialIndex material = builder.add_material({});
        Solid balls{.made = Made::by_union};
        for (int i = 0; i < 20; ++i)
            balls.parts.push_back(
                {.shape = SphereOf<double>{{0.1 * i - 1.0, 1.0 - 0.1 * i, 0}, 1}});
        Solid solid = balls;
        if (is_cut)
            solid = {.made = Made::by_intersection,
                     .parts = {balls, {.shape = PlaneOf<double>{{0, 0, 0}, {1, 1, 1}}}}};
        builder.add_solid(solid, material);
        builder.auto_camera = {.fit_camera = tilted, .lights = true};
        const Scene scene = std::move(builder).build();
        Frame frame(tilted, 1.0);
        include_shapes(scene, frame);
        return frame;
    };
    const Frame whole = frame_of(false), cut = frame_of(true);
    CHECK(cut.width() == Approx(whole.width()));
}

TEST_CASE("solids of solids are framed as wholes and discs as discs") {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    const auto camera_of = [&](SceneBuilder from) {
        from.auto_camera = {.fit_camera = FitCamera{}, .lights = true};
        return std::move(from).build().camera();
    };
    // The intersection of a large ball with a small box is as small as the box.
    Solid solid{.made = Made::by_intersection,
                .parts = {{.shape = SphereOf<double>{{0, 0, 0}, 100.0}},
                          {.shape = BoxOf<double>{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}}}};
    builder.add_solid(solid, material);
    CHECK(camera_of(std::move(builder)).from.z < 10.0F);

    SceneBuilder round;
    const MaterialIndex of_disc = round.add_material({});
    round.add(Disc{{0, 0, 0}, {0, 0, 1}, 1}, of_disc);
    const float from_front = camera_of(std::move(round)).from.z;
    SceneBuilder square;
    const MaterialIndex of_sphere = square.add_material({});
    square.add(Sphere{{0, 0, 0}, 1}, of_sphere);
    // The outline of a ball of the same radius is in front of its middle.
    CHECK(from_front < camera_of(std::move(square)).from.z);
    CHECK(from_front > 3.0F);
}
