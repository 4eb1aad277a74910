#include "core/optics/optics.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <cmath>

using namespace little_scene;

namespace {

constexpr double exactly = 1e-13;

} // namespace

TEST_CASE("a mirror sphere reflects by the textbook's formula") {
    Builder builder;
    builder.add_shape(Sphere{{0, 0, 0}, 1}, mirror());
    builder.add_shape(Plane{{10, 0, 0}, {-1, 0, 0}}, ruler({0, 0, 20}));
    const Scene scene = builder.finish();

    for (const double x : {0.1, 0.3, 0.5, 0.7}) {
        // From (x, 0, z) with normal (x, 0, z), (0, 0, -1) goes to (2 x z, 0, 2 z^2 - 1).
        const double z = std::sqrt(1.0 - x * x);
        const double t = (10.0 - x) / (2.0 * x * z);
        const double reached = z + t * (2.0 * z * z - 1.0);
        CHECK(gray_along(scene, {x, 0, 5}, {0, 0, -1}) ==
              Approx(std::clamp(reached / 20.0, 0.0, 1.0)).epsilon(exactly));
    }
}

TEST_CASE("a slab shifts a ray by the textbook's amount and keeps its direction") {
    const double n = 1.5, thickness = 2.0;
    for (const double degrees : {0.0, 10.0, 45.0, 80.0}) {
        const double sine = std::sin(degrees * 3.14159265358979323846 / 180.0);
        const double cosine = std::sqrt(1.0 - sine * sine);
        const double sine_inside = sine / n;
        const double tangent = sine / cosine;
        const double tangent_inside = sine_inside / std::sqrt(1.0 - sine_inside * sine_inside);

        const auto reached_at = [&](float depth) {
            Builder builder;
            builder.add_shape(Box{{-1000, -1000, -2}, {2000, 0, 0}, {0, 2000, 0}, {0, 0, 2}},
                              glass(1.5F));
            builder.add_shape(Plane{{0, 0, -depth}, {0, 0, 1}}, ruler({200, 0, 0}));
            return 200.0 * gray_along(builder.finish(), {0, 0, 1}, {sine, 0, -cosine});
        };
        const double straight = 11.0 * tangent;
        const double shift = thickness * (tangent - tangent_inside);
        CHECK(reached_at(10.0F) == Approx(straight - shift).epsilon(exactly).margin(exactly));
        CHECK(reached_at(20.0F) - reached_at(10.0F) ==
              Approx(10.0 * tangent).epsilon(exactly).margin(exactly));
    }
}

TEST_CASE("total reflection loses no light") {
    // Inside of water, below its surface y = 0, with a luminous floor and a dark sky.
    Builder builder;
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, glass(1.5F, Reflection::dielectric));
    builder.add_shape(Plane{{0, -1, 0}, {0, 1, 0}}, luminous({0.25F, 0.5F, 0.75F}));
    const Scene scene = builder.finish();
    const Vec3d beyond{1, 0.5, 0}, within{0.1, 1, 0};
    CHECK(color_along<double>(scene, {0, -0.5, 0}, beyond) == Vec3d(0.25, 0.5, 0.75));
    const Vec3d seen = color_along<double>(scene, {0, -0.5, 0}, within);
    CHECK(seen.x == Approx(0.25 * 0.04).epsilon(0.01));
}

TEST_CASE("glass without other reflection reflects totally beyond the critical angle") {
    Builder builder;
    builder.add_shape(Plane{{0, 0, 0}, {0, 1, 0}}, glass(1.5F, Reflection::constant));
    builder.add_shape(Plane{{0, -1, 0}, {0, 1, 0}}, luminous({0.25F, 0.5F, 0.75F}));
    const Scene scene = builder.finish();
    CHECK(color_along<double>(scene, {0, -0.5, 0}, {1, 0.5, 0}) == Vec3d(0.25, 0.5, 0.75));
    CHECK(color_along<double>(scene, {0, -0.5, 0}, {0.1, 1, 0}) == Vec3d(0.0));
}

TEST_CASE("glass in an evenly bright room cannot be seen") {
    for (const Reflection reflection : {Reflection::schlick, Reflection::dielectric}) {
        Builder builder;
        builder.background = Color(1.0F);
        builder.settings.max_depth = 400;
        builder.settings.min_weight = 1e-9F;
        builder.add_shape(Sphere{{0, 0, 0}, 1}, glass(1.5F, reflection));
        const Scene scene = builder.finish();
        for (const double x : {0.0, 0.5, 0.9, 0.99, 0.9999})
            CHECK(gray_along(scene, {x, 0, 5}, {0, 0, -1}) == Approx(1.0).epsilon(1e-6));
    }
}

TEST_CASE("absorption follows the length of the path inside") {
    const Vec3f absorption{0.125F, 0.5F, 1.0F};
    Material tinted = glass(1.0F);
    tinted.absorption = absorption;
    const auto expect = [&](const Scene& scene, const Vec3d& origin, double length) {
        const Vec3d color = color_along<double>(scene, origin, {0, 0, -1});
        for (int channel = 0; channel < 3; ++channel)
            CHECK(color[channel] ==
                  Approx(std::exp(-static_cast<double>(absorption[channel]) * length))
                      .epsilon(exactly));
    };
    Builder builder;
    builder.background = Color(1.0F);
    builder.add_shape(Box{{-1, -1, -3}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, tinted);
    builder.add_shape(Sphere{{10, 0, 0}, 3}, tinted);
    const Scene scene = builder.finish();
    expect(scene, {0, 0, 5}, 2.0);
    expect(scene, {10, 0, 5}, 6.0);
    expect(scene, {10, 0, 0}, 3.0); // the camera is inside
}

TEST_CASE("nothing shines through an infinite body that absorbs") {
    Material tinted = glass(1.5F);
    tinted.absorption = {0.125F, 0.0F, 1.0F};
    Builder builder;
    builder.background = {0.25F, 0.5F, 0.75F};
    builder.add_shape(Plane{{0, 0, 0}, {0, 0, 1}}, tinted);
    CHECK(color_along<double>(builder.finish(), {0, 0, 5}, {0, 0, -1}) == Vec3d(0.0, 0.5, 0.0));
}

TEST_CASE("a path ends behind a body that absorbs its weight") {
    Material tinted = glass(1.0F);
    tinted.absorption = Vec3f(1.0F);
    const auto seen = [&](float min_weight) {
        Builder builder;
        builder.background = Color(1.0F);
        builder.settings.min_weight = min_weight;
        builder.add_shape(Box{{-1, -1, -2}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, tinted);
        return gray_along(builder.finish(), {0, 0, 5}, {0, 0, -1});
    };
    const float weight = std::exp(-2.0F);
    CHECK(seen(0.99F * weight) == Approx(std::exp(-2.0)));
    CHECK(seen(1.01F * weight) == 0.0);
}

TEST_CASE("each refraction counts against the depth limit") {
    const auto seen = [](int max_depth) {
        Builder builder;
        builder.background = Color(1.0F);
        builder.settings.max_depth = max_depth;
        builder.add_shape(Sphere{{0, 0, 0}, 1}, glass(1.5F));
        builder.add_shape(Sphere{{0, 0, 5}, 1}, glass(1.5F));
        return gray_along(builder.finish(), {0, 0, 10}, {0, 0, -1});
    };
    CHECK(seen(0) == 0.0);
    CHECK(seen(1) == 0.0);
    CHECK(seen(3) == 0.0);
    CHECK(seen(4) == 1.0);
}

TEST_CASE("an opaque surface reflects alike from both sides") {
    // Behind the surface lies the material's index, whichever side is seen.
    Material varnish = black();
    varnish.reflection = Reflection::dielectric;
    Builder builder;
    builder.background = Color(1.0F);
    builder.add_shape(Plane{{0, 0, 0}, {0, 0, 1}}, varnish);
    const Scene scene = builder.finish();
    const double front = gray_along(scene, {0, 0, 5}, {0.5, 0, -1});
    CHECK(front > 0.04);
    CHECK(gray_along(scene, {0, 0, -5}, {0.5, 0, 1}) == Approx(front).epsilon(exactly));
}

TEST_CASE("a ray refracts by the index of the medium around it") {
    // Equal indices bend nothing: a sphere of water in a box of water.
    Builder builder;
    builder.add_shape(Box{{-2, -2, -2}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, glass(1.25F));
    builder.add_shape(Plane{{0, 0, -5}, {0, 0, 1}}, ruler({10, 0, 0}));
    const Vec3d origin{1, 0, 5}, direction{0.05, 0, -1};
    Builder with_sphere = builder;
    with_sphere.add_shape(Sphere{{1, 0, 0}, 1}, glass(1.25F));
    CHECK(gray_along(with_sphere.finish(), origin, direction) ==
          Approx(gray_along(builder.finish(), origin, direction)).epsilon(exactly));
}

TEST_CASE("media nest and can be left in any order") {
    MediaStacks stacks;
    CHECK(stacks.top(empty_space) == no_medium);
    Media media = stacks.entered(stacks.entered(empty_space, 7), 3);
    CHECK(stacks.top(media) == 3);
    media = stacks.left(media, 7);
    CHECK(stacks.top(media) == 3);
    CHECK(media == stacks.entered(empty_space, 3)); // equal stacks are stored once
    CHECK(stacks.left(media, 5) == media);          // never entered
    CHECK(stacks.left(media, 3) == empty_space);

    media = empty_space;
    for (MaterialIndex material = 0; material < 1000; ++material)
        media = stacks.entered(media, material);
    for (MaterialIndex material = 999; material > 0; --material) {
        CHECK(stacks.top(media) == material);
        media = stacks.left(media, material);
    }
    CHECK(stacks.top(media) == 0); // a deep stack forgets no medium
}

TEST_CASE("a camera may stand inside of bodies") {
    Material water = glass(1.25F, Reflection::dielectric);
    water.absorption = {1.0F, 0.25F, 0.0F};
    const Box tank{{-5, -5, -5}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
    const auto seen = [&](auto add_more) {
        Builder builder;
        builder.fog = {FogKind::exponential, {0.0F, 0.0F, 1.0F}, 0.0F, 1.0F, 0.5F};
        builder.add_shape(tank, water);
        builder.add_shape(Sphere{{0, 0, -4}, 0.5F}, luminous());
        add_more(builder);
        return color_along<double>(builder.finish(), {0, 0, 0}, {0.03, 0, -1});
    };
    const Vec3d alone = seen([](Builder&) {});
    const double length = -std::log(alone.x);
    CHECK(length == Approx(3.5).epsilon(0.02));
    CHECK(alone.y == Approx(std::exp(-0.25 * length)).epsilon(exactly));
    CHECK(alone.z == 1.0); // no fog in here
    // A ball of water in water cannot be seen, even if it surrounds the camera.
    for (const float z : {-2.0F, 0.0F}) {
        const Vec3d with_ball = seen([&](Builder& builder) {
            builder.add_shape(Sphere{{0.2F, 0, z}, 1}, water);
        });
        CHECK(with_ball.x == Approx(alone.x).epsilon(exactly));
        CHECK(with_ball.y == Approx(alone.y).epsilon(exactly));
    }
    // The glass around the camera does not absorb. Behind it, the water goes on.
    const Vec3d from_glass = seen([&](Builder& builder) {
        builder.add_shape(Sphere{{0, 0, 0}, 1}, glass(1.25F));
    });
    CHECK(from_glass.x == Approx(std::exp(1.0 - length)).epsilon(exactly));
    // Under the surface of an infinite sea.
    Builder sea;
    sea.background = Color(1.0F);
    sea.add_shape(Plane{{0, 3, 0}, {0, 1, 0}}, water);
    sea.add_shape(Sphere{{0, 0, -4}, 0.5F}, luminous());
    CHECK(color_along<double>(sea.finish(), {0, 0, 0}, {0, 0, -1}).x ==
          Approx(std::exp(-3.5)).epsilon(exactly));
}

TEST_CASE("an apex is seen from every direction that hits it") {
    // Seen from below: the needle's axis, which replaces the normal at the apex, points away.
    Builder builder;
    builder.background = Color(1.0F);
    Material lacquer = black();
    lacquer.reflection = Reflection::schlick;
    builder.add_shape(CappedCone{{0, 0, 0}, {0, 0, 1}, 0.125F, 0}, lacquer);
    const Scene scene = builder.finish();
    CHECK(gray_along(scene, {4, 0, -1}, {-4, 0, 2}) == Approx(0.04));
    CHECK(gray_along(scene, {4, 0, -1}, {-4, 0, 2.01}) == 1.0); // past it
}
