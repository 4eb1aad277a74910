#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

/// Opacity below 1: surfaces blend, in their order along the ray, with the scene straight behind
/// them.
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

TEST_CASE("transparent surfaces blend in their order along the ray") {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> fraction(0, 1);
    for (int round = 0; round < 20; ++round) {
        Builder builder;
        builder.settings.max_depth = 0; // rays that go straight on are no deeper
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

TEST_CASE("at most max_transparent transparent surfaces are seen") {
    for (const int most : {1, 2, 3}) {
        Builder builder;
        builder.settings.max_transparent = most;
        builder.background = Color(16.0F);
        for (int i = 0; i < 4; ++i)
            builder.add_shape(disc_at(static_cast<float>(-i)), pane(0.5F, 1.0F));
        builder.add_shape(disc_at(-9), luminous(Color(16.0F)));
        CHECK(seen_down(builder.finish()) == 1.0 + 15.0 * std::pow(0.5, most));
    }
}

TEST_CASE("a union of transparent balls has no walls inside") {
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

TEST_CASE("transparent surfaces do not bend or tint or deepen rays") {
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
    // The ray passes each of the 18 surfaces twice.
    CHECK(gray_along(builder.finish(), {0.5, 0.25, 39}, {0, 0, -1}) == std::pow(0.5, 36));
}

TEST_CASE("a transparent surface reflects and refracts in proportion to its opacity") {
    Builder builder;
    builder.background = Color(1.0F);
    Material half = glass(1.0F);
    half.reflectivity = 0.5F;
    half.transmission = 0.5F;
    half.opacity = 0.5F;
    builder.add_shape(Box{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, half);
    // At each surface, 1/2 of the light passes, 1/8 is transmitted and 1/4 reflected.
    builder.settings.max_depth = 2;
    const double through = 0.625, back = 0.25;
    CHECK(seen_down(builder.finish()) ==
          Approx(back + through * through + through * back * through).epsilon(0.02));
}

TEST_CASE("fully transparent panes do not change the fog") {
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

TEST_CASE("a transparent surface shades in proportion to its opacity") {
    Builder builder;
    Material matte = black();
    matte.pattern.colors[0] = Color(1.0F);
    matte.diffuse = 1.0F;
    builder.add_shape(Plane{{0, 0, 0}, {0, 0, 1}}, matte);
    builder.add_shape(Sphere{{0, 0, 5}, 1}, pane(0.25F, 0.0F));
    const Scene scene = builder.finish({.kind = LightKind::directional, .direction = {0, 0, -1}});
    CHECK(gray_along(scene, {9, 0, 9}, {-9, 0, -9}) == Approx(0.75 * 0.75));
    CHECK(gray_along(scene, {9, 0, 9}, {-4, 0, -9}) == Approx(1.0));
}

namespace {

constexpr double envelope = 0.375; // opacity

struct Ball {
    Vec3d center;
    double radius;
    bool is_core;
};
/// A union of transparent balls, and two opaque balls in it.
const std::vector<Ball> balls = {{{-0.8, 0, 0}, 1.2, false},
                                 {{0.8, 0, 0}, 1.2, false},
                                 {{0, 0.9, 0.3}, 1, false},
                                 {{-0.8, 0, 0}, 0.4, true},
                                 {{0.8, 0, 0}, 0.4, true}};

struct Wall {
    double t;
    const Ball* ball;
};

/// Returns where a line from a point meets the cores and the union's outer walls, in order.
std::vector<Wall> walls_along(const Vec3d& from, const Vec3d& direction) {
    struct Passage {
        double in, out;
        const Ball* ball;
    };
    std::vector<Passage> passages;
    for (const Ball& ball : balls) {
        const Vec3d offset = from - ball.center;
        const double half = dot(offset, direction);
        const double squared = half * half - dot(offset, offset) + ball.radius * ball.radius;
        if (squared > 0.0)
            passages.push_back({-half - std::sqrt(squared), -half + std::sqrt(squared), &ball});
    }
    std::vector<Wall> walls;
    for (const Passage& passage : passages)
        for (const double t : {passage.in, passage.out}) {
            const bool is_inner =
                !passage.ball->is_core &&
                std::any_of(passages.begin(), passages.end(), [&](const Passage& other) {
                    return other.ball != passage.ball && !other.ball->is_core && other.in < t &&
                           t < other.out;
                });
            if (t > 1e-9 && !is_inner) walls.push_back({t, passage.ball});
        }
    std::sort(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.t < b.t; });
    return walls;
}

/// Returns the gray of white surfaces that are lit from a direction.
double expected_along(const Vec3d& from, const Vec3d& direction, const Vec3d& to_light) {
    double color = 0.0, throughput = 1.0;
    for (const Wall& wall : walls_along(from, direction)) {
        const Vec3d point = from + wall.t * direction;
        Vec3d normal = (point - wall.ball->center) / wall.ball->radius;
        if (dot(normal, direction) > 0.0) normal = -normal;
        double light = std::max(dot(normal, to_light), 0.0);
        for (const Wall& between : walls_along(point, to_light))
            light *= between.ball->is_core ? 0.0 : 1.0 - envelope;
        const double opacity = wall.ball->is_core ? 1.0 : envelope;
        color += throughput * opacity * light;
        throughput *= 1.0 - opacity;
    }
    return color;
}

} // namespace

TEST_CASE("light into a transparent union passes only its outer walls") {
    Builder builder;
    Material matte = black();
    matte.pattern.colors[0] = Color(1.0F);
    matte.diffuse = 1.0F;
    const MaterialIndex core = builder.add_material(matte);
    matte.opacity = static_cast<float>(envelope);
    Solid solid{Made::by_union};
    for (const Ball& ball : balls) {
        Solid part;
        part.shape = SphereOf<double>{ball.center, ball.radius};
        if (ball.is_core)
            builder.add(SphereOf<double>{ball.center, ball.radius}, core);
        else
            solid.parts.push_back(part);
    }
    builder.add_solid(solid, builder.add_material(matte));
    const Scene scene = builder.finish({.kind = LightKind::directional, .direction = {-4, -6, -5}});
    const Vec3d to_light = normalized(Vec3d(4, 6, 5));
    int lit = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x) {
            const Vec3d from((x + 0.5) / 15 - 2, (y + 0.5) / 15 - 2, 9);
            const double seen = gray_along(scene, from, {0, 0, -1});
            const double expected = expected_along(from, {0, 0, -1}, to_light);
            lit += expected > 0.0 ? 1 : 0;
            if (std::abs(seen - expected) > 1e-6) {
                CAPTURE(x, y);
                CHECK(seen == expected);
            }
        }
    CHECK(lit > 1000);
}

TEST_CASE("opacities outside of 0 to 1 and max_transparent below 1 are refused") {
    Builder builder;
    CHECK_THROWS_AS(builder.add_material(pane(1.5F)), InvalidValue);
    CHECK_THROWS_AS(builder.add_material(pane(-0.5F)), InvalidValue);
    builder.settings.max_transparent = 0;
    CHECK_THROWS_AS(builder.finish(), InvalidValue);
}
