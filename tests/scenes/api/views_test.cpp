#include "raylane/raylane.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

using namespace raylane;
using library::Internals;
using tests::message_of;

namespace {

const Camera aside{.from = {6, 3, 8}, .at = {1, 0, 0}, .field_of_view = 50};
Settings sized(int width, int height) {
    Settings settings;
    settings.width = width;
    settings.height = height;
    return settings;
}
const Settings small = sized(48, 36);

Scene row_of_balls(const Camera& camera, int count = 5) {
    SceneBuilder builder;
    builder.camera = camera;
    builder.settings = small;
    builder.fog = {.kind = FogKind::exponential, .density = 0.02F};
    builder.add_light({.position = {3, 9, 9}});
    const MaterialIndex material = builder.add_material({.transmission = 0.25F});
    for (int i = 0; i < count; ++i)
        builder.add(Sphere{{static_cast<float>(i), 0, 0}, 0.75F}, material);
    return builder.build();
}

} // namespace

TEST_CASE("a scene seen by another camera equals one that is built with it") {
    const Scene scene = row_of_balls({});
    const std::vector<float> before = render(scene).rgb;
    const Scene same = scene.seen_by(aside);
    CHECK(same.camera().from == aside.from);
    CHECK(render(same).rgb == render(row_of_balls(aside)).rgb);
    // The first scene is unchanged. The second one gives its image again by its camera.
    CHECK(scene.camera().from == Camera{}.from);
    CHECK(render(scene).rgb == before);
    CHECK(render(same.seen_by({})).rgb == before);
    CHECK(message_of([&] { scene.seen_by({.field_of_view = 180}); }).find("camera/field_of_view") !=
          std::string::npos);
}

TEST_CASE("a scene seen by another camera shares the memory of shapes") {
    const Scene scene = row_of_balls({}, 5000), same = scene.seen_by(aside);
    const core::Scene &a = Internals::of(scene), &b = Internals::of(same);
    CHECK(a.hierarchy().nodes.data() == b.hierarchy().nodes.data());
    const auto& spheres = [](const core::Scene& inner) -> const core::Table<core::Sphere>& {
        return std::get<core::Table<core::Sphere>>(inner.shapes());
    };
    CHECK(spheres(a).plain_blocks().data() == spheres(b).plain_blocks().data());
    // The memory lasts as long as any of the scenes.
    std::optional<Scene> first = row_of_balls({}, 5000);
    const Scene second = first->seen_by(aside);
    first.reset();
    CHECK(render(second).rgb == render(same).rgb);
}

TEST_CASE("lights and fog that follow the camera move with another camera") {
    const Scene scene = parse("3\n\nC 0 0 0\nO 2 1 -3\nN 0 3 1\n", "atoms.xyz");
    REQUIRE(scene.lights().size() == 2);
    const Scene same = scene.seen_by(aside);
    REQUIRE(same.lights().size() == 2);
    CHECK(same.lights()[1].position != scene.lights()[1].position);
    CHECK(same.fog().start != scene.fog().start);
    const auto drawn = [](const Scene& viewed) { return render(viewed, {.settings = small}).rgb; };
    CHECK(drawn(same) != drawn(scene));
    CHECK(drawn(same.seen_by(scene.camera())) == drawn(scene));
}

TEST_CASE("a camera on all sees the whole scene in nearly the largest size") {
    const Scene scene = row_of_balls({});
    for (const Vec3 direction :
         {Vec3{0, 0, -1}, Vec3{-3, -1, 2}, Vec3{0, -1, 0}, Vec3{1e-20F, 0, 0}}) {
        Settings settings = sized(90, 30);
        settings.alpha = true;
        const Camera camera = scene.camera_on_all(direction, 3.0F);
        const Image image = render(scene.seen_by(camera), {.settings = settings});
        int left = 90, right = -1, top = 30, bottom = -1;
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 90; ++x)
                if (image.alpha[static_cast<std::size_t>(90 * y + x)] > 0.0F) {
                    left = std::min(left, x), right = std::max(right, x);
                    top = std::min(top, y), bottom = std::max(bottom, y);
                }
        CHECK(left >= 1);
        CHECK(right <= 88);
        CHECK(top >= 1);
        CHECK(bottom <= 28);
        CHECK((right - left > 70 || bottom - top > 22));
    }
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float aspect : {0.0F, -1.0F, nan})
        CHECK(message_of([&] { scene.camera_on_all({0, 0, -1}, aspect); }).find("aspect") == 0);
    for (const Vec3 direction : {Vec3{}, Vec3{nan, 0, 1}, Vec3{0, 0, INFINITY}})
        CHECK(message_of([&] { scene.camera_on_all(direction); }).find("direction") == 0);
    CHECK(message_of([&] {
              scene.camera_on_all({0, 0, -1}, 1e-7F);
          }) == "aspect: must be from 0.00001 to 100000, got 1e-07");
    SceneBuilder builder;
    builder.add_light({});
    builder.add(Plane{{0, -1, 0}, {0, 1, 0}}, builder.add_material({}));
    const Scene plane = builder.build();
    CHECK(message_of([&] { plane.camera_on_all(); }) ==
          "scene: must have a shape other than planes to frame");
}

TEST_CASE("a camera on all is valid for the scene or refused") {
    for (const float radius : {2e29F, 3e29F, 1e30F}) {
        SceneBuilder builder;
        builder.add(Sphere{{0, 0, 0}, radius}, builder.add_material({}));
        const Scene scene = builder.build();
        if (radius < 2.5e29F)
            CHECK_NOTHROW(scene.seen_by(scene.camera_on_all()));
        else
            CHECK(message_of([&] { scene.camera_on_all(); }).find("scene: is too large") == 0);
    }
}
