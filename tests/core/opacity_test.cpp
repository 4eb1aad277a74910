#include "tests/catch.hpp"
#include "tests/core/little_scene.hpp"

#include <cmath>
#include <random>

/// What opacity below 1 shows: surfaces blend, in the order of the ray, with what is straight
/// behind them.
using namespace raylane;
using namespace little_scene;

namespace {

Material pane(float opacity, float gray = 1.0F) {
    Material material = luminous(Color(gray));
    material.opacity = opacity;
    return material;
}

Disc disc_at(float z) {
    return {{0, 0, z}, {0, 0, 1}, 1};
}

double seen_down(const Scene& scene) {
    return gray_along(scene, {0.1, 0.2, 50}, {0, 0, -1});
}

Solid ball(double x, double radius) {
    Solid solid;
    solid.shape = SphereOf<double>{{x, 0, 0}, radius};
    return solid;
}

} // namespace

TEST_CASE("see-through surfaces blend in their order") {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> fraction(0, 1);
    for (int round = 0; round < 20; ++round) {
        Builder builder;
        builder.settings.max_depth = 0; // to go straight on is no depth
        builder.background = Color(0.5F);
        double expected = 0.5;
        for (int i = 0; i < 40; ++i) { // the nearest last
            const float opacity = i % 7 == 3 ? 0.0F : fraction(random), gray = fraction(random);
            builder.add_shape(disc_at(static_cast<float>(i)), pane(opacity, gray));
            expected = static_cast<double>(opacity) * static_cast<double>(gray) +
                       (1.0 - static_cast<double>(opacity)) * expected;
        }
        CHECK(seen_down(builder.finish()) == Approx(expected).epsilon(1e-12));
    }
}

TEST_CASE("no more see-through surfaces are seen than asked for") {
    for (const int most : {1, 2, 3}) {
        Builder builder;
        builder.settings.max_see_through = most;
        builder.background = Color(16.0F);
        for (int i = 0; i < 4; ++i)
            builder.add_shape(disc_at(static_cast<float>(-i)), pane(0.5F, 1.0F));
        builder.add_shape(disc_at(-9), luminous(Color(16.0F)));
        CHECK(seen_down(builder.finish()) == 1.0 + 15.0 * std::pow(0.5, most));
    }
}

TEST_CASE("a union of see-through balls has no walls inside") {
    Builder builder;
    Solid both{Made::by_union};
    both.parts = {ball(-0.5, 1), ball(0.5, 1), ball(0, 1.2)};
    builder.add_solid(both, builder.add_material(pane(0.25F)));
    CHECK(gray_along(builder.finish(), {5, 0, 0}, {-1, 0, 0}) == 1.0 - 0.75 * 0.75);
    Builder apart;
    for (const float x : {-0.5F, 0.5F})
        apart.add_shape(Sphere{{x, 0, 0}, 1}, pane(0.25F));
    CHECK(gray_along(apart.finish(), {5, 0, 0}, {-1, 0, 0}) == 1.0 - std::pow(0.75, 4));
}

TEST_CASE("what is seen through is neither bent nor tinted, and mirrors at any depth") {
    Builder builder;
    builder.settings.max_depth = 1;
    for (int i = 0; i < 9; ++i) {
        Material shell = pane(0.5F, 0.0F);
        shell.index = 2.0F;
        shell.absorption = Vec3f(5.0F);
        builder.add_shape(Sphere{{0, 0, static_cast<float>(3 * i)}, 1}, shell);
    }
    builder.add_shape(Plane{{0, 0, -2}, {0, 0, 1}}, mirror());
    builder.add_shape(Plane{{0, 0, 40}, {0, 0, 1}}, luminous());
    // There and back.
    CHECK(gray_along(builder.finish(), {0.5, 0.25, 39}, {0, 0, -1}) == std::pow(0.5, 36));
}

TEST_CASE("a see-through surface reflects and refracts as much as there is of it") {
    Builder builder;
    builder.background = Color(1.0F);
    Material half = glass(1.0F);
    half.reflectivity = 0.5F;
    half.transmission = 0.5F;
    half.opacity = 0.5F;
    builder.add_shape(Box{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, half);
    // Of each surface 1/2 passes, 1/8 is transmitted and 1/4 reflected.
    builder.settings.max_depth = 2;
    const double through = 0.625, back = 0.25;
    CHECK(seen_down(builder.finish()) ==
          Approx(back + through * through + through * back * through).epsilon(0.02));
}

TEST_CASE("fog lies before what is behind a pane as if there were none") {
    for (const FogKind kind : {FogKind::linear, FogKind::exponential, FogKind::linear_z}) {
        const auto seen = [&](bool with_panes) {
            Builder builder;
            builder.fog = {.kind = kind, .color = Color(0.25F), .density = 0.05F};
            builder.fog.start = kind == FogKind::linear_z ? 10.0F : 45.0F;
            builder.fog.end = kind == FogKind::linear_z ? -10.0F : 80.0F;
            for (int i = 0; with_panes && i < 9; ++i)
                builder.add_shape(disc_at(static_cast<float>(3 * i)), pane(0.0F));
            builder.add_shape(disc_at(-1), luminous());
            return seen_down(builder.finish());
        };
        CHECK(seen(true) == Approx(seen(false)).epsilon(1e-12));
        CHECK(seen(false) != 1.0);
    }
}

TEST_CASE("a see-through surface shades as much as there is of it") {
    Builder builder;
    Material matte = black();
    matte.pattern.colors[0] = Color(1.0F);
    matte.diffuse = 1.0F;
    builder.add_shape(Plane{{0, 0, 0}, {0, 0, 1}}, matte);
    builder.add_shape(Sphere{{0, 0, 5}, 1}, pane(0.25F, 0.0F));
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = {0, 0, -1};
    const Scene scene = builder.finish(sun);
    CHECK(gray_along(scene, {9, 0, 9}, {-9, 0, -9}) == Approx(0.75 * 0.75));
    CHECK(gray_along(scene, {9, 0, 9}, {-4, 0, -9}) == Approx(1.0));
}

TEST_CASE("opacities are fractions, and of one surface at least is seen") {
    Builder builder;
    CHECK_THROWS_AS(builder.add_material(pane(1.5F)), InvalidValue);
    CHECK_THROWS_AS(builder.add_material(pane(-0.5F)), InvalidValue);
    builder.settings.max_see_through = 0;
    CHECK_THROWS_AS(builder.finish(), InvalidValue);
}
