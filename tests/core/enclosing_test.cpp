#include "core/reference/enclosing.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

using namespace raylane;
using namespace raylane::core;

/// Media around points, and when the search for them runs.

namespace {

Material glass() {
    Material material;
    material.transmission = 1.0F;
    return material;
}

Scene scene_with(bool uses_glass, bool on_glass) {
    SceneBuilder builder;
    builder.wants_light = false;
    const MaterialIndex opaque = builder.add_material({}), clear = builder.add_material(glass());
    const MaterialIndex other = builder.add_material(glass());
    for (int i = 0; i < 40; ++i)
        builder.add(Sphere{Vec3f(static_cast<float>(3 * i), 0.0F, 0.0F), 1.0F}, opaque);
    if (uses_glass) {
        builder.add(Sphere{Vec3f(0.0F, 10.0F, 0.0F), 1.0F}, clear);
        builder.add(Sphere{Vec3f(0.5F, 10.0F, 0.0F), 1.0F}, other);
        builder.add(Sphere{Vec3f(0.0F, 14.0F, 0.0F), 0.5F}, clear);
    }
    if (on_glass) builder.add(Plane{Vec3f(0.0F, -5.0F, 0.0F), Vec3f(0.0F, 1.0F, 0.0F)}, clear);
    return std::move(builder).build();
}

struct Asker {
    const Scene& scene;
    MediaStacks stacks{};
    Searcher<double> searcher{scene, Search::hierarchy};

    Media at(const Vec3d& point) { return enclosing_media(scene, searcher, stacks, point); }
    bool has_searched() const {
        return searcher.counters.nodes != 0 || searcher.counters.shapes != 0;
    }
};

} // namespace

TEST_CASE("an unused transmissive material does not make a scene transmissive") {
    const Scene scene = scene_with(false, false);
    CHECK_FALSE(scene.transmissive().any);
    Asker asker{scene};
    CHECK(asker.at(Vec3d(0.0)) == empty_space);
    CHECK_FALSE(asker.has_searched());
}

TEST_CASE("media are searched for only where a transmissive body may be") {
    const Scene scene = scene_with(true, true);
    Asker asker{scene};
    CHECK(asker.at(Vec3d(0.0)) == empty_space);
    CHECK(asker.at(Vec3d(0.0, 14.51, 0.0)) == empty_space);
    CHECK(asker.stacks.top(asker.at(Vec3d(0.0, -6.0, 0.0))) == 1); // under the plane
    CHECK_FALSE(asker.has_searched());
    CHECK(asker.at(Vec3d(0.0, 12.0, 0.0)) == empty_space); // between two bodies
    CHECK_FALSE(asker.has_searched());
    CHECK(asker.stacks.top(asker.at(Vec3d(-0.9, 10.0, 0.0))) == 1);
    CHECK(asker.stacks.top(asker.at(Vec3d(1.4, 10.0, 0.0))) == 2);
    CHECK(asker.stacks.top(asker.at(Vec3d(0.0, 14.4999999, 0.0))) == 1);
}

TEST_CASE("two sheets can enclose a body together") {
    SceneBuilder builder;
    builder.wants_light = false;
    const MaterialIndex clear = builder.add_material(glass());
    builder.add(Disc{Vec3f(0.0F, 0.0F, 1.0F), Vec3f(0.0F, 0.0F, 1.0F), 5.0F}, clear);
    builder.add(Disc{Vec3f(0.0F, 0.0F, -1.0F), Vec3f(0.0F, 0.0F, -1.0F), 5.0F}, clear);
    builder.add(Sphere{Vec3f(40.0F, 0.0F, 0.0F), 1.0F}, clear);
    const Scene scene = std::move(builder).build();
    Asker asker{scene};
    CHECK(asker.at(Vec3d(0.5, 0.5, 0.0)) != empty_space);
    CHECK(asker.at(Vec3d(0.5, 0.5, 1.5)) == empty_space);
    CHECK(asker.at(Vec3d(40.0, 0.5, 0.0)) != empty_space);
    CHECK(may_be_in_body(scene, {Vec3f(0.0F, 0.0F, -0.5F), Vec3f(0.5F, 0.5F, 0.5F)}));
    CHECK_FALSE(may_be_in_body(scene, {Vec3f(6.0F, -9.0F, -9.0F), Vec3f(38.0F, 9.0F, 9.0F)}));
    CHECK(may_be_in_body(scene, {Vec3f(6.0F, -9.0F, -9.0F), Vec3f(39.5F, 9.0F, 9.0F)}));
}

TEST_CASE("a point near the surface of a transmissive body is on the right side") {
    SceneBuilder builder;
    builder.wants_light = false;
    const MaterialIndex clear = builder.add_material(glass());
    const Vec3f center(1.1F, -2.3F, 0.7F);
    builder.add(Sphere{center, 0.3F}, clear);
    const Scene scene = std::move(builder).build();
    Asker asker{scene};
    ray_sets::Random random(3);
    const double radius = static_cast<double>(0.3F);
    int inside = 0;
    for (int i = 0; i < 3000; ++i) {
        const double distance = radius * (1.0 + random.uniform(-1.0, 1.0) * 0x1p-40);
        Vec3d direction = random.direction();
        if (i % 3 == 0) // where the sphere touches its bounds
            direction = Vec3d(i % 9 == 0, i % 9 == 3, i % 9 == 6) * (i % 2 == 0 ? 1.0 : -1.0);
        const Vec3d point = convert<double>(center) + distance * direction;
        const Vec3d off = point - convert<double>(center);
        if (std::abs(core::length(off) / radius - 1.0) < 0x1p-48)
            continue; // too close to the surface to decide in double
        const bool is_in = core::length(off) < radius;
        inside += is_in ? 1 : 0;
        CHECK((asker.at(point) != empty_space) == is_in);
    }
    CHECK(inside > 1000);
}
