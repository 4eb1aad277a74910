#include "core/scene/scene.hpp"
#include "core/shapes/shapes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

/// Bounds of the visible surface of each part of a large solid.

namespace {

Solid made(Made by, std::vector<Solid> parts) {
    Solid solid{by};
    solid.parts = std::move(parts);
    return solid;
}

Solid ball(const Vec3d& center, double radius) {
    return of_shape(SphereOf<double>{center, radius});
}

Scene scene_of(const Solid& solid) {
    SceneBuilder builder;
    builder.wants_light = false;
    builder.add_material({});
    builder.add_solid(solid, 0);
    return std::move(builder).build();
}

/// Returns a random solid of solids, of at most `balls` balls.
Solid any_solid(Random& random, int balls, int depth, bool large = true) {
    if (balls == 1 || depth == 0)
        return large ? ball(random.cube(1.0), random.uniform(3.0, 6.0))
                     : ball(random.cube(4.0), random.uniform(0.1, 2.0));
    constexpr Made kinds[] = {Made::by_union, Made::by_intersection, Made::by_difference};
    Solid solid{kinds[random.integer(0, 2)]};
    const int parts = std::min(balls, depth == 1 ? balls : random.integer(2, 24));
    for (int part = 0; part < parts; ++part) {
        const bool is_common = solid.made == Made::by_intersection;
        const bool is_cut = solid.made == Made::by_difference && part == 0;
        solid.parts.push_back(
            any_solid(random, balls / parts, depth - 1, is_common || (is_cut && large)));
    }
    return solid;
}

std::vector<SphereOf<double>> balls_of(const Solid& solid) {
    if (solid.made == Made::of_shape) return {std::get<SphereOf<double>>(solid.shape)};
    std::vector<SphereOf<double>> spheres;
    for (const Solid& part : solid.parts)
        for (const SphereOf<double>& next : balls_of(part))
            spheres.push_back(next);
    return spheres;
}

/// Returns whether a point is inside of a solid if `of_ball` says whether it is inside of the ball
/// with the number `ball`. `number` is the number of the next ball.
bool is_inside(const Solid& solid, const Vec3d& point, std::size_t ball, bool of_ball,
               std::size_t& number) {
    if (solid.made == Made::of_shape) {
        if (number++ == ball) return of_ball;
        const auto& sphere = std::get<SphereOf<double>>(solid.shape);
        return length(point - sphere.center) < sphere.radius;
    }
    bool any = false, all = true, first = true;
    for (const Solid& part : solid.parts) {
        bool inside = is_inside(part, point, ball, of_ball, number);
        if (solid.made == Made::by_difference && !std::exchange(first, false)) inside = !inside;
        any = any || inside;
        all = all && inside;
    }
    return solid.made == Made::by_union ? any : all;
}

} // namespace

TEST_CASE("a part's bounds contain all of its surface that is the solid's") {
    Random random(1);
    int seen = 0;
    for (int round = 0; round < 60; ++round) {
        const Solid solid = any_solid(random, random.integer(2, 300), random.integer(1, 4));
        if (solid.made == Made::of_shape) continue;
        const Scene scene = scene_of(solid);
        const std::vector<SphereOf<double>> balls = balls_of(solid);
        for (std::size_t i = 0; i < 500; ++i) {
            const auto part =
                static_cast<std::size_t>(random.integer(0, static_cast<int>(balls.size()) - 1));
            const Vec3d point = balls[part].center + balls[part].radius * random.direction();
            std::size_t from = 0, again = 0;
            if (is_inside(solid, point, part, true, from) ==
                is_inside(solid, point, part, false, again))
                continue;
            ++seen;
            const auto id = static_cast<ShapeId>(part);
            CAPTURE(round, part, point.x, point.y, point.z);
            const Solids& solids = scene.solids();
            REQUIRE(solids.node(solids.part_of(id)).traced);
            // The point is rounded.
            Bounds bounds = *solids.bounds_of(id);
            for (int axis = 0; axis < 3; ++axis) {
                bounds.lower[axis] -= 1e-4F;
                bounds.upper[axis] += 1e-4F;
            }
            REQUIRE(bounds.contains(point));
        }
    }
    CHECK(seen > 1000);
}

TEST_CASE("bounds of hundreds of facets are small on average") {
    constexpr int count = 300;
    Solid solid{Made::by_intersection};
    for (int i = 0; i < count; ++i) { // on a Fibonacci spiral
        const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
        const Vec3d normal(r * std::cos(2.399963 * i), r * std::sin(2.399963 * i), z);
        solid.parts.push_back(of_shape(PlaneOf<double>{normal, normal}));
    }
    solid.parts.push_back(of_shape(BoxOf<double>{{-2, -2, -2}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}));
    const Scene scene = scene_of(solid);
    double area = 0.0;
    for (ShapeId id = 0; id < count; ++id)
        area += scene.solids().bounds_of(id)->half_area();
    CAPTURE(area / count);
    CHECK(area / count < 6.0); // 12 for the whole solid
}

TEST_CASE("solids of very many parts are built part by part and not pair by pair") {
    Random random(2);
    std::vector<Solid> parts;
    SECTION("that are nearly the same") {
        for (int i = 0; i < 8'192; ++i)
            parts.push_back(ball(random.cube(1e-9), 1.0));
        for (const Made by : {Made::by_intersection, Made::by_difference})
            CHECK(scene_of(made(by, parts)).shape_count() == parts.size());
    }
    SECTION("holes in a block") {
        parts.push_back(
            of_shape(BoxOf<double>{{-10, -10, -10}, {20, 0, 0}, {0, 20, 0}, {0, 0, 20}}));
        for (int i = 0; i < 16'384; ++i)
            parts.push_back(ball(random.cube(10.0), 0.2));
        const Scene scene = scene_of(made(Made::by_difference, parts));
        const Solids& solids = scene.solids();
        int traced = 0;
        for (ShapeId id = 0; id < scene.shape_count(); ++id)
            traced += solids.node(solids.part_of(id)).traced ? 1 : 0;
        CHECK(traced > 16'000);
    }
    SECTION("of solids of two, in each other") {
        for (int i = 0; i < 8'192; ++i)
            parts.push_back(ball(random.cube(1e-9), 1.0));
        for (bool is_union = false; parts.size() > 1; is_union = !is_union) {
            std::vector<Solid> pairs;
            for (std::size_t i = 0; i < parts.size(); i += 2)
                pairs.push_back(made(is_union ? Made::by_union : Made::by_intersection,
                                     {parts[i], parts[i + 1]}));
            parts = std::move(pairs);
        }
        CHECK(scene_of(parts.front()).shape_count() == 8'192);
    }
}
