#include "tests/meetings/gathering.hpp"
#include "tests/oracle/truth.hpp"
#include "tests/scenes/api/exam.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// Tests of queries with any number of answers for each ray or point. exam.cpp checks crossings
/// against the oracle.
using namespace raylane;
using namespace raylane::tests;

namespace {

using Strings = std::vector<std::string>;

/// Returns a word for each crossing: "+0@2" if the ray enters shape 0 at t = 2, "-0@2" if it leaves
/// it. "=" in front marks a tie with the crossing before, "~" a touch.
Strings words(const CrossingRows& rows, std::size_t i = 0) {
    Strings strings;
    for (std::uint64_t k = rows.first[i]; k < rows.first[i + 1]; ++k) {
        std::ostringstream word;
        word << (rows.tied[k] != 0 ? "=" : "") << (rows.touching[k] != 0 ? "~" : "")
             << (rows.entering[k] != 0 ? "+" : "-") << rows.shape_id[k] << "@" << rows.t[k];
        strings.push_back(word.str());
    }
    return strings;
}

CrossingRows crossings(const Scene& scene, const Rays& rays, const CrossingOptions& options = {},
                       CrossingStatistics* statistics = nullptr) {
    CrossingRows rows;
    Tracer(scene).crossings(rays.span(), rows, options, statistics);
    return rows;
}

template <class... Shapes>
Scene scene_of_materials(const Shapes&... shapes) {
    SceneBuilder builder;
    (builder.add(shapes, builder.add_material({})), ...);
    return builder.build();
}

Rays one_ray(const Vec3& origin, const Vec3& direction) {
    Rays rays;
    rays.add(origin, direction);
    return rays;
}

/// Returns the length along one ray inside of each material.
using Lengths = std::vector<std::pair<MaterialIndex, double>>;

Lengths lengths_along(const Scene& scene, const Vec3& origin, const Vec3& direction, float t_min,
                      float t_max) {
    Rays rays = one_ray(origin, direction);
    rays.t_min = {t_min};
    rays.t_max = {t_max};
    LengthRows rows;
    Tracer(scene).path_lengths(rays.span(), rows);
    Lengths lengths;
    for (std::size_t k = 0; k < rows.material.size(); ++k)
        lengths.emplace_back(rows.material[k], rows.length[k]);
    return lengths;
}

} // namespace

TEST_CASE("all crossings come in order with ties and touches marked") {
    // The cells of a reactor's pin: a sphere in a cylinder, between planes.
    const Scene pin =
        scene_of_materials(Sphere{{0, 0, 0}, 2.5F}, OpenCylinder{{0, 0, -8}, {0, 0, 16}, 4},
                           Plane{{0, 0, 1.5F}, {0, 0, 1}}, Plane{{0, 0, -1.5F}, {0, 0, 1}});
    CHECK(words(crossings(pin, one_ray({0, 0, 0}, {4, 0, 3}))) ==
          Strings{"-0@0.5", "=-2@0.5", "-1@1"});
    CHECK(words(crossings(pin, one_ray({0, 0, 0}, {-4, 0, -3}))) ==
          Strings{"+3@0.5", "=-0@0.5", "-1@1"});
    CHECK(words(crossings(pin, one_ray({-10, 0, 0}, {1, 0, 0}))) ==
          Strings{"+1@6", "+0@7.5", "-0@12.5", "-1@14"});
    CHECK(words(crossings(pin, one_ray({-10, 2.5F, 0}, {1, 0, 0}))).at(1) == "~+0@10");
    CHECK(words(crossings(pin, one_ray({-10, 2.5F, 0}, {1, 0, 0}))).at(2) == "=~-0@10");
    CHECK(words(crossings(pin, one_ray({0, 2.5F, -20}, {0, 0, 1}), {.most = 1})).size() == 1);
    const Scene ball = scene_of_materials(Sphere{{0, 0, 0}, 2.5F});
    CHECK(words(crossings(ball, one_ray({-10, 2.5F, 0}, {1, 0, 0}), {.most = 1})) ==
          Strings{"~+0@10"});

    // Coincident surfaces come in the order of their ids.
    const OpenCylinder cylinder{{0, 0, 0}, {0, 0, 1}, 1};
    CHECK(words(crossings(scene_of_materials(cylinder, cylinder),
                          one_ray({-2, 0, 0.5F}, {1, 0, 0}))) ==
          Strings{"+0@1", "=+1@1", "-0@3", "=-1@3"});
}

TEST_CASE("a ray through the common edge of a polygon's triangles crosses one of them") {
    SceneBuilder builder;
    const Triangle square[] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                               {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    builder.add_polygon(std::span(square), builder.add_material({}));
    CHECK(words(crossings(builder.build(), one_ray({0.5F, 0.5F, 1}, {0, 0, -1}))).size() == 1);
}

TEST_CASE("crossings have normals on request and limits of their number and of t") {
    const Scene scene = scene_of_materials(Sphere{{0, 0, 0}, 1}, Sphere{{0, 0, 0}, 2});
    Rays rays = one_ray({-4, 0, 0}, {2, 0, 0});
    const CrossingRows two = crossings(scene, rays, {.most = 2, .normals = true});
    CHECK(words(two) == Strings{"+1@1", "+0@1.5"});
    CHECK(two.normal_x == std::vector<float>{-1, -1});
    CHECK(two.normal_y == std::vector<float>{0, 0});
    CHECK(two.normal_z == std::vector<float>{0, 0});
    CHECK(two.face == std::vector<std::uint8_t>{0, 0});
    rays.t_min = {1};
    rays.t_max = {2.5F};
    const CrossingRows between = crossings(scene, rays);
    CHECK(words(between) == Strings{"+0@1.5", "-0@2.5"});
    CHECK(between.normal_x.empty());
    // From a given origin surface.
    const ShapeId left[] = {1};
    const std::uint8_t inward[] = {1};
    RaySpan from = rays.span();
    from.t_min = from.t_max = {};
    const float x[] = {-2};
    from.origin_x = x;
    from.origin_shape = left;
    from.origin_inward = inward;
    CrossingRows rows;
    Tracer(scene).crossings(from, rows);
    CHECK(words(rows) == Strings{"+0@0.5", "-0@1.5", "-1@2"});
}

TEST_CASE("invalid rays have empty rows and an empty array of rays has none") {
    const Scene scene = scene_of_materials(Sphere{{0, 0, 0}, 1});
    Rays rays = one_ray({-2, 0, 0}, {0, 0, 0});
    rays.add({-2, 0, 0}, {1, 0, 0});
    rays.add({-2, not_a_number, 0}, {1, 0, 0});
    CHECK(crossings(scene, rays).first == std::vector<std::uint64_t>{0, 0, 2, 2});
    CHECK(crossings(scene, Rays()).first == std::vector<std::uint64_t>{0});
    LengthRows lengths;
    Tracer(scene).path_lengths(rays.span(), lengths);
    CHECK(lengths.first == std::vector<std::uint64_t>{0, 0, 1, 1});
    CHECK(lengths.length == std::vector<double>{2.0});
    std::vector<std::uint64_t> counts(3, 77);
    QueryStatistics statistics;
    Tracer(scene).count_crossings(rays.span(), counts, &statistics);
    CHECK(counts == std::vector<std::uint64_t>{0, 2, 0});
    CHECK(statistics.refused == 2);
    Tracer(scene).count_crossings(Rays().span(), {});
    counts.pop_back();
    CHECK_THROWS_AS(Tracer(scene).count_crossings(rays.span(), counts), InvalidValue);
    const std::vector<float> x{0, not_a_number, 1, infinity}, zero(4, 0.0F);
    SolidRows solids;
    Tracer(scene).contains(PointSpan{x, zero, zero}, solids);
    CHECK(solids.first == std::vector<std::uint64_t>{0, 1, 1, 2, 2});
    CHECK(solids.on_surface == std::vector<std::uint8_t>{0, 1});
    CHECK_THROWS_AS(Tracer(scene).contains(PointSpan{x, zero, {}}, solids), InvalidValue);
}

TEST_CASE("rows do not depend on the number of threads and statistics count the decisions") {
    const Heap many = heap(true, sanitized ? 4 : 30, 3);
    CrossingRows alone, shared;
    CrossingStatistics by_one, by_three;
    Tracer(many.scene, {.threads = 1})
        .crossings(many.rays.span(), alone, {.normals = true}, &by_one);
    Tracer(many.scene, {.threads = 3})
        .crossings(many.rays.span(), shared, {.normals = true}, &by_three);
    CHECK(alone.first == shared.first);
    CHECK(alone.t == shared.t);
    CHECK(alone.shape_id == shared.shape_id);
    CHECK(alone.normal_z == shared.normal_z);
    CHECK(by_one.by_bounds > 0);
    CHECK(by_one.by_digits > 0);
    CHECK(by_one.exactly > 0);
    CHECK(by_one.by_bounds + by_one.by_digits + by_one.exactly ==
          by_three.by_bounds + by_three.by_digits + by_three.exactly);
    LengthRows of_one, of_three;
    Tracer(many.scene, {.threads = 1}).path_lengths(many.rays.span(), of_one);
    Tracer(many.scene, {.threads = 3}).path_lengths(many.rays.span(), of_three);
    CHECK(of_one.length == of_three.length);
    CHECK(of_one.first == of_three.first);
    SolidLengthRows solids_of_one, solids_of_three;
    Tracer(many.scene, {.threads = 1}).solid_lengths(many.rays.span(), solids_of_one);
    Tracer(many.scene, {.threads = 3}).solid_lengths(many.rays.span(), solids_of_three);
    CHECK(solids_of_one.length == solids_of_three.length);
    CHECK(solids_of_one.shape_id == solids_of_three.shape_id);
    CHECK(solids_of_one.first == solids_of_three.first);
}

TEST_CASE("rays with more crossings than one pass finds have all of them") {
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    constexpr int shells = 300;
    for (int i = 1; i <= shells; ++i)
        builder.add(Sphere{{0, 0, 0}, static_cast<float>(i)}, material);
    Rays rays;
    for (int i = 0; i < 1024; ++i)
        rays.add({-400, 0.25F * static_cast<float>(i), 0}, {1, 0, 0});
    const CrossingRows rows = crossings(builder.build(), rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        // A ray touches the shell whose radius is the ray's height.
        const int height = static_cast<int>(i / 4) + (i % 4 == 0 ? 0 : 1);
        const int met = shells - std::max(height, 1) + 1;
        CHECK(rows.first[i + 1] - rows.first[i] == 2U * static_cast<unsigned>(met));
    }
}

TEST_CASE("crossings are counted without rows, within limits and by any number of threads") {
    for (const bool lattice : {false, true}) {
        Heap many = heap(lattice, sanitized ? 4 : 12, 11);
        Rays& rays = many.rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            rays.t_min.push_back(i % 3 == 0 ? 0.5F : 0.0F);
            rays.t_max.push_back(i % 5 == 0 ? 1.0F : infinity);
        }
        const CrossingRows rows = crossings(many.scene, rays);
        for (const int threads : {1, 3}) {
            std::vector<std::uint64_t> counts(rays.size(), 77);
            Tracer(many.scene, {.threads = threads}).count_crossings(rays.span(), counts);
            for (std::size_t i = 0; i < rays.size(); ++i)
                CHECK(counts[i] == rows.first[i + 1] - rows.first[i]);
        }
    }
    // Triangles of a polygon count as one at their common edge.
    SceneBuilder builder;
    const Triangle square[] = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                               {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    builder.add_polygon(std::span(square), builder.add_material({}));
    std::uint64_t count = 0;
    Tracer(builder.build())
        .count_crossings(one_ray({0.5F, 0.5F, 1}, {0, 0, -1}).span(), {&count, 1});
    CHECK(count == 1);
}

TEST_CASE("the first crossing of a ray is its nearest hit with the same normal") {
    const Heap many = heap(false, sanitized ? 3 : 12, 5);
    const Tracer tracer(many.scene);
    CrossingRows rows;
    tracer.crossings(many.rays.span(), rows, {.normals = true});
    const Hits hits = intersect(tracer, many.rays);
    for (std::size_t i = 0; i < many.rays.size(); ++i) {
        const std::uint64_t k = rows.first[i];
        CHECK((rows.first[i + 1] == k) == (hits.shape[i] == no_shape));
        if (rows.first[i + 1] == k) continue;
        CHECK(rows.shape_id[k] == hits.shape[i]);
        CHECK(static_cast<float>(rows.t[k]) == hits.t[i]);
        CHECK(rows.entering[k] == hits.entering[i]);
        CHECK((rows.normal_x[k] == hits.nx[i] && rows.normal_y[k] == hits.ny[i] &&
               rows.normal_z[k] == hits.nz[i]));
    }
}

TEST_CASE("crossings behind the first are not compared if only the first is wanted") {
    const Heap many = heap(false, 3, 7);
    CrossingStatistics statistics;
    CHECK(!crossings(many.scene, many.rays, {.most = 1}, &statistics).t.empty());
    CHECK(statistics.by_bounds + statistics.by_digits + statistics.exactly == 0);
}

TEST_CASE("rays along the axis of cylinders and cones need no more than the bounds in double") {
    const Vec3 axis{0.3F, -0.7F, 1.1F}, along{0.6F, -1.4F, 2.2F};
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    builder.add(CappedCylinder{{0.1F, 0.2F, 0.3F}, axis, 2}, material);
    builder.add(CappedCone{{0.1F, 0.2F, 0.3F}, along, 2, 3}, material);
    builder.add(OpenCylinder{{0.1F, 0.2F, 0.3F}, along, 2.5F}, material);
    Rays rays;
    for (int i = 0; i < 64; ++i) {
        const float u = 0.1F * static_cast<float>(i % 8), v = 0.1F * static_cast<float>(i / 8);
        rays.add({u - 3, v + 7, u + v - 11}, along);
        rays.add({u + 3, v - 7, u + v + 11}, {-axis.x, -axis.y, -axis.z});
    }
    CrossingStatistics statistics;
    const CrossingRows rows = crossings(builder.build(), rays, {}, &statistics);
    CHECK(rows.t.size() > 4 * rays.size() / 2);
    CHECK(statistics.beyond_double == 0);
}

TEST_CASE("path lengths are the lengths inside of each material") {
    SceneBuilder builder;
    const MaterialIndex glass = builder.add_material({}), lead = builder.add_material({});
    builder.add(Sphere{{0, 0, 0}, 2}, glass);
    builder.add(Sphere{{1, 0, 0}, 2}, glass);                  // overlaps the first
    builder.add(Sphere{{0, 0, 0}, 1}, lead);                   // inside of both
    builder.add(OpenCylinder{{9, 0, -1}, {0, 0, 2}, 1}, lead); // not a solid
    builder.add(Sphere{{-4, 0, 0}, 2}, glass);                 // touches the first
    const Scene scene = builder.build();
    const auto lengths = [&](const Vec3& origin, const Vec3& direction, float t_min, float t_max) {
        return lengths_along(scene, origin, direction, t_min, t_max);
    };
    CHECK(lengths({-10, 0, 0}, {3, 0, 0}, 0, infinity) == Lengths{{glass, 9.0}, {lead, 2.0}});
    CHECK(lengths({0, 0, 0}, {0.5F, 0, 0}, 0, infinity) == Lengths{{glass, 3.0}, {lead, 1.0}});
    CHECK(lengths({0, 0, 0}, {0.5F, 0, 0}, 1, 5) == Lengths{{glass, 2.0}, {lead, 0.5}});
    CHECK(lengths({0, 0, 0}, {1, 0, 0}, 5, 9).empty());
    CHECK(lengths({0, 0, 0}, {1, 0, 0}, 2, 2).empty());
    CHECK(lengths({-4, -5, 0}, {0, 1, 0}, 0, infinity) == Lengths{{glass, 4.0}});
    CHECK(lengths({-6, -5, 0}, {0, 1, 0}, 0, infinity).empty()); // touches
}

TEST_CASE("solid lengths are the lengths inside of each solid") {
    SceneBuilder builder;
    const MaterialIndex glass = builder.add_material({}), lead = builder.add_material({});
    builder.add(Sphere{{0, 0, 0}, 2}, glass);
    builder.add(Sphere{{1, 0, 0}, 2}, glass);                  // overlaps the first
    builder.add(Sphere{{0, 0, 0}, 2}, glass);                  // counts as the first
    builder.add(OpenCylinder{{9, 0, -1}, {0, 0, 2}, 1}, lead); // not a solid
    const raylane::Solid ball(Sphere{{8, 0, 0}, 2}), hole(Sphere{{8, 0, 0}, 1});
    const ShapeId shell = builder.add(difference_of(ball, {hole}), lead);
    const raylane::Solid below(Plane{{0, 0, -50}, {0, 0, 1}});
    const ShapeId ground = builder.add(below, lead);
    const Tracer tracer(builder.build());
    const auto lengths = [&](const Vec3& origin, const Vec3& direction, float t_min, float t_max) {
        Rays rays = one_ray(origin, direction);
        rays.t_min = {t_min};
        rays.t_max = {t_max};
        SolidLengthRows rows;
        tracer.solid_lengths(rays.span(), rows);
        CHECK(rows.first == std::vector<std::uint64_t>{0, rows.length.size()});
        Lengths sums;
        for (std::size_t k = 0; k < rows.length.size(); ++k)
            sums.emplace_back(rows.shape_id[k], rows.length[k]);
        return sums;
    };
    CHECK(lengths({-10, 0, 0}, {3, 0, 0}, 0, infinity) ==
          Lengths{{0, 4.0}, {1, 4.0}, {shell, 2.0}});
    CHECK(lengths({0, 0, 0}, {0.5F, 0, 0}, 0, infinity) ==
          Lengths{{0, 2.0}, {1, 3.0}, {shell, 2.0}});
    CHECK(lengths({0, 0, 0}, {0.5F, 0, 0}, 1, 5) == Lengths{{0, 1.5}, {1, 2.0}});
    CHECK(lengths({8, 0, 0}, {0, 0, -2}, 0, 50) == Lengths{{shell, 1.0}, {ground, 50.0}});
    CHECK(lengths({8, 0, -60}, {1, 0, 0}, 0, infinity) == Lengths{{ground, infinity}});
    // From a given origin surface, which the rounded origin is outside of.
    Rays rays = one_ray({2.00001F, 0, 0}, {-1, 0, 0});
    RaySpan from = rays.span();
    const ShapeId left[] = {0};
    const std::uint8_t inward[] = {1};
    from.origin_shape = left;
    from.origin_inward = inward;
    SolidLengthRows rows;
    tracer.solid_lengths(from, rows);
    REQUIRE(rows.shape_id == std::vector<ShapeId>{0, 1});
    CHECK(rows.length[0] == Approx(4.00001));
    CHECK(rows.length[1] == Approx(3.00001));
}

TEST_CASE("a clipped solid is open and has no inside for lengths and points") {
    SceneBuilder builder;
    const MaterialIndex glass = builder.add_material({});
    const raylane::Solid ball(Sphere{{0, 0, 0}, 1}), plane(Plane{{0, 0, 0}, {-1, 0, 0}});
    builder.add(clipped(ball, {plane}), glass);
    builder.add(raylane::Solid(Sphere{{4, 0, 0}, 1}), glass);
    const Scene scene = builder.build();
    LengthRows rows;
    // Both rays pass the open side of the first ball and leave it by the other side.
    Rays rays = one_ray({0, 0.5F, 0}, {1, 0, 0});
    rays.add({-3, 0, 0}, {1, 0, 0});
    Tracer(scene).path_lengths(rays.span(), rows);
    REQUIRE(rows.first == std::vector<std::uint64_t>{0, 1, 2});
    CHECK(rows.length[0] == Approx(std::sqrt(3.0)));
    CHECK(rows.length[1] == 2.0);
    SolidRows solids;
    const std::vector<double> x = {0.5, 4}, zero = {0, 0};
    Tracer(scene).contains(DoublePointSpan{x, zero, zero}, solids);
    CHECK(solids.first == std::vector<std::uint64_t>{0, 0, 1});
}

TEST_CASE("rays have a length inside of an unbounded solid whether they cross its surface or not") {
    SceneBuilder builder;
    const MaterialIndex stone = builder.add_material({}), gold = builder.add_material({});
    const raylane::Solid below(Plane{{0, 0, 0}, {0, 0, 1}}), hole(Sphere{{0, 0, -5}, 1});
    builder.add(difference_of(below, {hole}), stone);
    builder.add(raylane::Solid(Plane{{0, 0, -50}, {0, 0, 1}}), gold);
    builder.add(clipped(below, {raylane::Solid(Plane{{0, 0, 0}, {1, 0, 0}})}), gold); // open
    const Scene scene = builder.build();
    const auto lengths = [&](const Vec3& origin, const Vec3& direction, float t_min, float t_max) {
        return lengths_along(scene, origin, direction, t_min, t_max);
    };
    CHECK(lengths({3, 0, -1}, {2, 0, 0}, 0, 50) == Lengths{{stone, 100.0}});
    CHECK(lengths({3, 0, -1}, {2, 0, 0}, 20, 50) == Lengths{{stone, 60.0}});
    CHECK(lengths({3, 0, -1}, {2, 0, 0}, 0, infinity) == Lengths{{stone, infinity}});
    CHECK(lengths({3, 0, -1}, {0, 0, -1}, 0, 99) == Lengths{{stone, 99.0}, {gold, 50.0}});
    CHECK(lengths({3, 0, -60}, {0, 0, -1}, 1, 2) == Lengths{{stone, 1.0}, {gold, 1.0}});
    CHECK(lengths({0, 0, 5}, {0, 0, -1}, 0, 100) == Lengths{{stone, 93.0}, {gold, 45.0}});
    CHECK(lengths({0, 0, 5}, {0, 0, -1}, 0, infinity) ==
          Lengths{{stone, infinity}, {gold, infinity}});
    CHECK(lengths({0, 0, -5}, {0, 0, 1}, 0, 100) == Lengths{{stone, 4.0}});
    CHECK(lengths({3, 0, -1}, {0, 0, 1}, 0, 100) == Lengths{{stone, 1.0}});
    CHECK(lengths({3, 0, -1}, {0, 0, 1}, 1, infinity).empty());
    // From the surface into the solid, out of it, and along the surface.
    CHECK(lengths({3, 0, 0}, {1, 0, -1e-30F}, 0, 8) == Lengths{{stone, 8.0}});
    CHECK(lengths({3, 0, 0}, {1, 0, 1e-30F}, 0, 8).empty());
    CHECK(lengths({3, 0, 0}, {1, 0, 0}, 0, 8).empty());
    CHECK(lengths({3, 0, 1}, {1, 0, 0}, 0, infinity).empty());
}

TEST_CASE("lengths and crossings and points agree for unbounded solids") {
    tests::Random random(seed(20261127));
    const auto part = [&](int depth, const auto& self) -> raylane::Solid {
        const auto small = [&] {
            return Vec3{static_cast<float>(random.integer(-2, 2)),
                        static_cast<float>(random.integer(-2, 2)),
                        static_cast<float>(random.integer(-2, 2))};
        };
        if (depth == 0) {
            if (random.integer(0, 1) == 0)
                return raylane::Solid(Sphere{small(), static_cast<float>(random.integer(1, 2))});
            Vec3 normal = small();
            if (normal.x == 0 && normal.y == 0 && normal.z == 0) normal.z = 1;
            return raylane::Solid(Plane{small(), normal});
        }
        const std::vector<raylane::Solid> parts = {self(depth - 1, self), self(depth - 1, self)};
        switch (random.integer(0, 2)) {
        case 0:
            return union_of(parts);
        case 1:
            return intersection_of(parts);
        default:
            return difference_of(parts[0], {parts[1]});
        }
    };
    constexpr double t_max = 64;
    int around = 0;
    for (int round = 0; round < rounds(300, 30); ++round) {
        SceneBuilder builder;
        builder.add(part(random.integer(0, 3), part), builder.add_material({}));
        const Scene scene = builder.build();
        const Tracer tracer(scene);
        Rays rays;
        for (int i = 0; i < 40; ++i) {
            const core::Vec3f o = random.small_integers(4), d = random.small_integers(2);
            rays.add({o.x, o.y, o.z}, {d.x, d.y, d.z});
        }
        rays.t_max.assign(rays.size(), static_cast<float>(t_max));
        CrossingRows rows;
        tracer.crossings(rays.span(), rows);
        LengthRows lengths;
        tracer.path_lengths(rays.span(), lengths);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const core::Vec3d o(rays.x[i], rays.y[i], rays.z[i]),
                d(rays.dx[i], rays.dy[i], rays.dz[i]);
            if (d == core::Vec3d(0.0)) continue;
            std::vector<double> ends = {0.0};
            ends.insert(ends.end(), rows.t.begin() + static_cast<std::ptrdiff_t>(rows.first[i]),
                        rows.t.begin() + static_cast<std::ptrdiff_t>(rows.first[i + 1]));
            ends.push_back(t_max);
            double expected = 0.0;
            bool runs_along = false; // in a surface: points do not tell whether the ray is inside
            for (std::size_t k = 1; k < ends.size(); ++k) {
                // Not half way, where another surface may be. The rounded t makes the point exact.
                const double t = ends[k - 1] + 0.48828125 * (ends[k] - ends[k - 1]);
                const core::Vec3d at = o + d * std::ldexp(std::round(std::ldexp(t, 20)), -20);
                const double x[] = {at.x}, y[] = {at.y}, z[] = {at.z};
                SolidRows solids;
                tracer.contains(DoublePointSpan{x, y, z}, solids);
                if (solids.shape_id.empty()) continue;
                runs_along = runs_along || solids.on_surface[0] != 0;
                expected += (ends[k] - ends[k - 1]) * std::sqrt(core::squared_length(d));
            }
            double sum = 0.0;
            for (std::uint64_t k = lengths.first[i]; k < lengths.first[i + 1]; ++k)
                sum += lengths.length[k];
            if (runs_along) continue;
            CAPTURE(round, i, o.x, o.y, o.z, d.x, d.y, d.z, words(rows, i));
            CHECK(sum == Approx(expected).margin(1e-9));
            if (rows.first[i] == rows.first[i + 1] && sum > 0.0) ++around;
        }
    }
    CHECK(around > 100);
}

namespace {

using Intervals = std::vector<std::pair<oracle::Number, oracle::Number>>;

/// Returns the intervals of t of a ray inside of solids, by shape.
std::map<ShapeId, Intervals> intervals_of(const oracle::Sight& sight) {
    std::map<ShapeId, oracle::Number> begins;
    std::map<ShapeId, Intervals> intervals;
    for (const oracle::Found& found : sight.all()) {
        if (found.hit.entering) {
            begins[found.shape] = found.hit.t;
            continue;
        }
        const auto begin = begins.find(found.shape);
        intervals[found.shape].emplace_back(
            begin == begins.end() ? oracle::Number(0) : begin->second, found.hit.t);
    }
    return intervals;
}

/// Returns the length of the union of intervals.
oracle::Number length_of(Intervals parts) {
    std::sort(parts.begin(), parts.end());
    oracle::Number length = 0, end = 0;
    for (const auto& [from, to] : parts) {
        if (to > end) length += to - std::max(from, end);
        end = std::max(to, end);
    }
    return length;
}

/// Checks a row of lengths in the order of their bodies. Returns the number of lengths.
long check_lengths(const std::map<std::uint32_t, Intervals>& truth, const oracle::Number& speed,
                   std::span<const std::uint32_t> bodies, std::span<const double> lengths) {
    std::size_t k = 0;
    for (const auto& [body, parts] : truth) {
        const oracle::Number length = length_of(parts) * speed;
        if (length < 1e-60) continue; // zero but for the oracle's rounding
        REQUIRE(k < bodies.size());
        CHECK(bodies[k] == body);
        const double answer = lengths[k++];
        const double ulp = std::nextafter(answer, std::numeric_limits<double>::max()) - answer;
        CHECK(abs(oracle::Number(answer) - length) < ulp);
    }
    CHECK(k == bodies.size());
    return static_cast<long>(k);
}

} // namespace

TEST_CASE("lengths inside of solids are within an ulp for grazing rays") {
    ray_sets::Random random(seed(20261124));
    long of_materials = 0, of_solids = 0;
    for (int round = 0; round < rounds(3, 1); ++round)
        for (const meetings::Kind& kind : meetings::gatherings) {
            if (kind.least > 30) continue;
            const meetings::Meeting meeting =
                kind.make(random.integer(kind.least, kind.most), random, 30);
            const std::vector<tests::AnyShape> shapes = valid(meeting.shapes);
            const std::vector<char> counts = which_count(shapes, Sides::some);
            const Tracer tracer(scene_of(shapes, Sides::some)); // three materials
            const oracle::Neighbours neighbours(shapes);
            Rays rays;
            for (const core::Ray<float>& ray : meeting.rays)
                rays.add({ray.origin.x, ray.origin.y, ray.origin.z},
                         {ray.direction.x, ray.direction.y, ray.direction.z});
            LengthRows rows;
            tracer.path_lengths(rays.span(), rows);
            SolidLengthRows solids;
            tracer.solid_lengths(rays.span(), solids);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const core::Ray<double> ray = rays.ray(i);
                const oracle::Sight sight(shapes, neighbours, ray, [&](ShapeId id, bool) {
                    return counts[id] != 0 &&
                           std::visit(
                               []<class Shape>(const Shape&) { return core::is_solid<Shape>; },
                               shapes[id]);
                });
                const std::map<ShapeId, Intervals> by_solid = intervals_of(sight);
                std::map<MaterialIndex, Intervals> by_material;
                for (const auto& [id, parts] : by_solid)
                    by_material[id % 3].insert(by_material[id % 3].end(), parts.begin(),
                                               parts.end());
                const oracle::Number speed =
                    sqrt(oracle::Number(ray.direction.x) * ray.direction.x +
                         oracle::Number(ray.direction.y) * ray.direction.y +
                         oracle::Number(ray.direction.z) * ray.direction.z);
                const auto row = [i](const auto& column, const std::vector<std::uint64_t>& first) {
                    return std::span(column).subspan(first[i], first[i + 1] - first[i]);
                };
                of_materials += check_lengths(by_material, speed, row(rows.material, rows.first),
                                              row(rows.length, rows.first));
                of_solids += check_lengths(by_solid, speed, row(solids.shape_id, solids.first),
                                           row(solids.length, solids.first));
            }
        }
    CHECK(of_materials > 60);
    CHECK(of_solids > of_materials);
}

TEST_CASE("contains decides exactly whether points are in solids or on them") {
    ray_sets::Random random(seed(20261125));
    long inside = 0, on_surface = 0, outside = 0;
    for (int round = 0; round < rounds(3, 1); ++round)
        for (const meetings::Kind& kind : meetings::gatherings) {
            if (kind.least > 30) continue;
            const meetings::Meeting meeting =
                kind.make(random.integer(kind.least, kind.most), random, 40);
            const std::vector<tests::AnyShape> shapes = valid(meeting.shapes);
            const Scene scene = scene_of(shapes, Sides::some);
            // Points of rays: where they cross surfaces, rounded to doubles, and on a lattice.
            std::vector<double> x, y, z;
            for (const core::Ray<float>& narrow : meeting.rays) {
                const core::Ray<double> ray{core::convert<double>(narrow.origin),
                                            core::convert<double>(narrow.direction)};
                for (const double t : {0.0, 1.0, 0.5, random.uniform(0.0, 2.0)}) {
                    const core::Vec3d point = ray.origin + t * ray.direction;
                    x.push_back(point.x);
                    y.push_back(point.y);
                    z.push_back(point.z);
                }
            }
            SolidRows rows;
            Tracer(scene).contains(DoublePointSpan{x, y, z}, rows);
            std::vector<ShapeId> cell(x.size(), 77);
            std::vector<MaterialIndex> material(x.size(), 77);
            std::vector<std::uint8_t> on_cell(x.size(), 77);
            Tracer(scene).cells(DoublePointSpan{x, y, z}, {cell, material, on_cell});
            for (std::size_t i = 0; i < x.size(); ++i) {
                // A point is inside of a convex solid if a line through it crosses the solid on
                // both sides.
                const core::Ray<double> line{{x[i], y[i], z[i]}, {0.41, 0.57, 0.71}};
                std::vector<std::pair<ShapeId, int>> truth, answer;
                for (ShapeId id = 0; id < shapes.size(); ++id) {
                    const bool is_solid =
                        std::visit([]<class Shape>(const Shape&) { return core::is_solid<Shape>; },
                                   shapes[id]);
                    bool is_copy = false;
                    for (ShapeId other = id % 3; other < id; other += 3)
                        is_copy = is_copy || are_same(shapes[other], shapes[id]);
                    if (!is_solid || is_copy) continue;
                    bool behind = false, ahead = false, here = false;
                    for (const oracle::Hit& hit : oracle::crossings(shapes[id], line)) {
                        const int side = oracle::compare(
                            hit.root, oracle::Root::quotient(oracle::Exact(0), oracle::Exact(1)));
                        behind = behind || side < 0;
                        ahead = ahead || side > 0;
                        here = here || side == 0;
                    }
                    const bool is_in = here || (behind && ahead);
                    (here ? on_surface : is_in ? inside : outside) += 1;
                    if (is_in) truth.emplace_back(id, here ? 1 : 0);
                }
                for (std::uint64_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
                    answer.emplace_back(rows.shape_id[k], rows.on_surface[k]);
                CHECK(answer == truth);
                const auto [last, on] = truth.empty() ? std::pair(no_shape, 0) : truth.back();
                CHECK(cell[i] == last);
                CHECK(material[i] == (truth.empty() ? no_material : last % 3));
                CHECK(on_cell[i] == on);
            }
        }
    CHECK(inside > 300);
    CHECK(on_surface > 50);
    CHECK(outside > 300);
}
