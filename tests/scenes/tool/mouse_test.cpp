#include "scenes/tool/window/mouse.hpp"
#include "tests/support/catch.hpp"

using namespace raylane;
using namespace raylane::core;
using scenes::Orbit;

namespace {

View start() {
    View view;
    view.camera.from = {0, 0, 4};
    view.camera.at = {0, 0, 0};
    view.camera.up = {0, 1, 0};
    view.lights = {{.kind = LightKind::point, .position = {1, 0, 4}}};
    return view;
}

void check(const Vec3f& found, const Vec3f& expected) {
    for (int axis = 0; axis < 3; ++axis)
        CHECK(found[axis] == Approx(expected[axis]).margin(1e-5));
}

} // namespace

TEST_CASE("a camera turns around its target together with its lights") {
    Orbit orbit(start());
    orbit.turn(90.0, 0.0);
    check(orbit.view().camera.from, {4, 0, 0});
    check(orbit.view().lights[0].position, {4, 0, -1});
    orbit.turn(-90.0, 30.0);
    check(orbit.view().camera.from, {0, 2, 3.4641016F});
    check(orbit.view().camera.at, {0, 0, 0});
    orbit.turn(270.0, 0.0);
    orbit.turn(90.0, -30.0);
    check(orbit.view().camera.from, {0, 0, 4});
}

TEST_CASE("a camera never goes over the poles") {
    Orbit orbit(start());
    orbit.turn(0.0, 500.0);
    const Camera top = orbit.view().camera;
    CHECK(top.from.y == Approx(4.0 * 0.99985).epsilon(1e-4));
    CHECK(top.from.z > 0.0F);
    orbit.turn(0.0, -1000.0);
    CHECK(orbit.view().camera.from.y == Approx(-4.0 * 0.99985).epsilon(1e-4));
    orbit.turn(0.0, 89.0);
    check(orbit.view().camera.from, {0, 0, 4});
}

TEST_CASE("panning moves the camera and its lights along the image plane") {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        View view = start();
        view.camera.projection = projection;
        view.camera.field_of_view = 90.0F;
        view.camera.height = 8.0F;
        Orbit orbit(view);
        orbit.turn(90.0, 0.0); // looks along -x, and right is -z
        orbit.pan(0.25, 0.5);
        check(orbit.view().camera.at, {0, 4, -2});
        check(orbit.view().camera.from, {4, 4, -2});
        check(orbit.view().lights[0].position, {4, 4, -3});
    }
}

TEST_CASE("zoom enlarges the target by its factor") {
    Orbit orbit(start());
    orbit.zoom(2.0);
    check(orbit.view().camera.from, {0, 0, 2});
    View view = start();
    view.camera.projection = Projection::orthographic;
    view.camera.height = 8.0F;
    Orbit flat(view);
    flat.zoom(2.0);
    CHECK(flat.view().camera.height == 4.0F);
    check(flat.view().camera.from, {0, 0, 4});
}

TEST_CASE("fog that follows the camera stays at the target") {
    View view = start();
    view.fog = {.kind = FogKind::linear, .start = 3.0F, .end = 9.0F};
    Orbit orbit(view);
    orbit.zoom(2.0);
    CHECK(orbit.view().fog.start == 1.0F);
    CHECK(orbit.view().fog.end == 7.0F);
    orbit.zoom(4.0);
    CHECK(orbit.view().fog.start == 0.0F);
    CHECK(orbit.view().fog.end == 5.5F);
}
