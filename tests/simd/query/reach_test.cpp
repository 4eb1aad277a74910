#include "simd/isa/isa.hpp"
#include "simd/query/transparency_walk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"

#include <cmath>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;

/// The work for a ray depends on the shapes near it, not on the camera's place, the scale of the
/// scene, or the distance from which the ray starts.

namespace {

constexpr int sphere_count = 2000;
constexpr std::size_t ray_count = 300;

Scene cloud(double size, double camera) {
    SceneBuilder builder;
    builder.wants_light = false;
    builder.camera.from = {0.0F, 0.0F, static_cast<float>(camera)};
    builder.add_material({});
    ray_sets::Random random(1605);
    for (int i = 0; i < sphere_count; ++i) {
        const auto across = [&] { return static_cast<float>(size * random.uniform(-1.0, 1.0)); };
        builder.add(Sphere{{across(), across(), across()}, static_cast<float>(0.03 * size)}, 0);
    }
    return std::move(builder).build();
}

struct Work {
    EngineCounters counters;
    int hits = 0;
};

/// Returns the work for `count` rays. `aim` returns each of them, in doubles.
template <class Aim>
Work work_for(const Scene& scene, std::size_t count, const Aim& aim) {
    const SceneData data(scene);
    Paths paths{};
    const Arena stream = arena_for([&](Arena& a) { paths.take_from(a, count, false); });
    paths.count = count;
    paths.start_nowhere(0, count);
    for (std::size_t lane = 0; lane < count; ++lane) {
        const Ray<double> ray = aim();
        for (int axis = 0; axis < 3; ++axis) {
            paths.origin[axis][lane] = ray.origin[axis];
            paths.direction[axis][lane] = ray.direction[axis];
        }
    }
    TransparencyWalk finder(data, {&kernels_of(best_isa()), Precision::exact});
    const Arena found = arena_for([&](Arena& a) { finder.take_from(a, count); });
    Work work;
    finder.nearest(paths, nullptr, work.counters);
    for (std::size_t lane = 0; lane < count; ++lane)
        work.hits += static_cast<int>(finder.hits().slot[lane] != no_slot);
    return work;
}

/// Returns the work for rays from about `distance` sizes away into the cloud.
Work work_for(const Scene& scene, double size, double distance) {
    ray_sets::Random random(729);
    return work_for(scene, ray_count, [&]() -> Ray<double> {
        const Vec3d from = random.direction() * (distance * random.uniform(0.7, 1.0));
        const Vec3d to = random.direction() * random.uniform(0.0, 1.0);
        return {size * from, normalized(to - from)};
    });
}

void check_same(const Work& a, const Work& b) {
    CHECK(a.hits == b.hits);
    CHECK(a.counters.nodes == b.counters.nodes);
    CHECK(a.counters.shapes == b.counters.shapes);
    CHECK(a.counters.refined == b.counters.refined);
    CHECK(a.counters.doubtful == b.counters.doubtful);
}

} // namespace

TEST_CASE("the work for a ray does not depend on the camera or on the scale of the scene") {
    const Work work = work_for(cloud(1.0, 5.0), 1.0, 3.0);
    CHECK(work.hits > 100);
    check_same(work, work_for(cloud(1.0, 5e6), 1.0, 3.0));
    for (const int exponent : {-40, -20, 20, 40}) {
        CAPTURE(exponent);
        const double size = std::ldexp(1.0, exponent);
        check_same(work, work_for(cloud(size, 5.0), size, 3.0));
    }
}

TEST_CASE("rays from far away have little more work than others") {
    const Scene scene = cloud(1.0, 5.0);
    const Work near = work_for(scene, 1.0, 3.0);
    for (const double distance : {100.0, 1e4, 1e6, 1e8}) {
        CAPTURE(distance);
        const Work far = work_for(scene, 1.0, distance);
        CHECK(far.hits > 100);
        CHECK(far.counters.shapes < 2 * near.counters.shapes);
    }
}

TEST_CASE("the first hit ends the search although the ray touches all shapes behind it") {
    SceneBuilder builder;
    builder.wants_light = false;
    const MaterialIndex material = builder.add_material({});
    for (int i = 0; i < 4000; ++i)
        builder.add(Sphere{{2.0F * static_cast<float>(i), 0, 0}, 1}, material);
    const Work work = work_for(std::move(builder).build(), 1, [] {
        return Ray<double>{{-5, 1, 0}, {1, 0, 0}};
    });
    CHECK(work.hits == 1);
    CHECK(work.counters.shapes < 1000);
}

/// Rays are exactly in the plane.
TEST_CASE("rays in the plane of a floor leave nothing to the reference") {
    SceneBuilder builder;
    builder.wants_light = false;
    const MaterialIndex material = builder.add_material({});
    const auto corner = [](int i, int k) {
        return Vec3f(static_cast<float>(i), 0.5F, static_cast<float>(k));
    };
    for (int i = 0; i < 40; ++i)
        for (int k = 0; k < 40; ++k) {
            builder.add(Triangle{corner(i, k), corner(i + 1, k), corner(i, k + 1)}, material);
            builder.add(Triangle{corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1)},
                        material);
        }
    ray_sets::Random random(5);
    const Work work = work_for(std::move(builder).build(), ray_count, [&]() -> Ray<double> {
        const Vec3d to(random.uniform(0.0, 40.0), 0.5, random.uniform(0.0, 40.0));
        const Vec3d from(-3.0, 0.5, random.uniform(0.0, 40.0));
        return {from, normalized(to - from)};
    });
    CHECK(work.hits == 0);
    CHECK(work.counters.refined > 0);
    CHECK(work.counters.doubtful == 0);
}
