#include "core/reference/search.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "simd/stream/tile_order.hpp"
#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

using namespace raylane;
using namespace raylane::tests;

/// Tests of streams: rays that have something in common, that have limits, or that start on
/// surfaces that other rays hit.

namespace {

using core::Vec3d;
using core::Vec3f;

#ifdef RAYLANE_FEW_RAYS
constexpr int ray_count = 300;
#else
constexpr int ray_count = 1500; // more than are examined together
#endif

float uniform(Random& random, double low, double high) {
    return static_cast<float>(random.uniform(low, high));
}

/// Returns a scene of balls and sticks in the unit cube, above a plane.
Scene balls() {
    Random random(5);
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    const auto any_point = [&] {
        return Vec3{uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)};
    };
    for (int i = 0; i < 300; ++i)
        builder.add(Sphere{any_point(), 0.04F}, material);
    for (int i = 0; i < 100; ++i)
        builder.add(CappedCylinder{any_point(), {0.1F, uniform(random, -0.1, 0.1), 0}, 0.02F},
                    material);
    builder.add(Plane{{0, 0, -0.1F}, {0, 0, 1}}, material);
    return builder.build();
}

enum class Way { from_a_point, to_a_point, to_a_point_by_distance, parallel, any };
constexpr Way all_ways[] = {Way::from_a_point, Way::to_a_point, Way::to_a_point_by_distance,
                            Way::parallel, Way::any};

/// Returns rays in the order of an image's pixels, line by line.
Rays rays_of(Way way, bool with_limits) {
    Random random(6);
    Rays rays;
    for (int i = 0; i < ray_count; ++i) {
        const float x = static_cast<float>(i % 64) / 64.0F, y = static_cast<float>(i / 64) / 24.0F;
        Vec3f from(x, y, 2.0F), along(0.0F, 0.0F, -1.0F);
        float t_max = infinity;
        switch (way) {
        case Way::from_a_point:
            from = {0.4F, 0.6F, 3.0F};
            along = Vec3f(x, y, 1.0F) - from;
            break;
        case Way::to_a_point:
        case Way::to_a_point_by_distance:
            from.z = -0.05F;
            along = Vec3f(0.3F, 0.2F, 1.7F) - from;
            t_max = 1.0F;
            if (way == Way::to_a_point) break;
            t_max = core::length(along);
            along = along / t_max;
            break;
        case Way::parallel:
            break;
        case Way::any:
            from = {uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)};
            along = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        }
        if (i % 97 == 5) along.y = not_a_number;
        rays.add({from.x, from.y, from.z}, {along.x, along.y, along.z});
        rays.t_max.push_back(with_limits && i % 7 == 0 ? std::min(t_max, 1.5F) : t_max);
        if (with_limits) rays.t_min.push_back(i % 5 == 0 ? 0.0F : uniform(random, 0, 1.5));
    }
    if (way != Way::to_a_point && way != Way::to_a_point_by_distance && !with_limits)
        rays.t_max.clear();
    return rays;
}

} // namespace

TEST_CASE("rays in one call have the answers that they have alone") {
    const Tracer tracer(balls(), {.threads = 1});
    for (const Way way : all_ways)
        for (const bool with_limits : {false, true}) {
            const Rays rays = rays_of(way, with_limits);
            const Hits together = intersect(tracer, rays);
            const std::vector<std::uint8_t> blocked = occluded(tracer, rays);
            int hits = 0, different = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                Hits alone(1);
                tracer.intersect(rays.part(i, 1), alone.span());
                std::uint8_t blocked_alone = 77;
                tracer.occluded(rays.part(i, 1), std::span(&blocked_alone, 1));
                const bool same = together.t[i] == alone.t[0] && together.nx[i] == alone.nx[0] &&
                                  together.ny[i] == alone.ny[0] && together.nz[i] == alone.nz[0] &&
                                  together.shape[i] == alone.shape[0] &&
                                  together.entering[i] == alone.entering[0] &&
                                  blocked[i] == blocked_alone &&
                                  (blocked[i] == 1) == (together.shape[i] != no_shape);
                different += same ? 0 : 1;
                hits += together.shape[i] != no_shape ? 1 : 0;
            }
            CAPTURE(static_cast<int>(way), with_limits, hits);
            CHECK(different == 0);
            CHECK(hits > ray_count / 8);
        }
}

namespace {

/// Rays in double, next to the floats' and between them.
struct DoubleRays {
    std::vector<double> columns[6];

    explicit DoubleRays(const Rays& rays) {
        const std::vector<float>* const floats[] = {&rays.x,  &rays.y,  &rays.z,
                                                    &rays.dx, &rays.dy, &rays.dz};
        for (int k = 0; k < 6; ++k)
            for (std::size_t i = 0; i < rays.size(); ++i)
                columns[k].push_back(static_cast<double>((*floats[k])[i]) *
                                     (i % 3 == 0 ? 1.0 : 1.0 + 0x1p-40));
    }
    DoubleRaySpan part(std::size_t first, std::size_t count) const {
        const auto part_of = [&](int k) { return std::span(columns[k]).subspan(first, count); };
        return {part_of(0), part_of(1), part_of(2), part_of(3), part_of(4), part_of(5)};
    }
};

/// Returns the number of rays whose answers in calls of one to five rays differ from those in one
/// call.
template <class AnyRays>
int different_in_short_calls(const Tracer& tracer, const AnyRays& rays, std::size_t count) {
    Hits together(count);
    std::vector<std::uint8_t> blocked(count, 77);
    tracer.intersect(rays.part(0, count), together.span());
    tracer.occluded(rays.part(0, count), blocked);
    int different = 0;
    for (std::size_t first = 0, some = 0; first < count; first += some) {
        some = std::min(some % 5 + 1, count - first);
        Hits alone(some);
        std::vector<std::uint8_t> blocked_alone(some, 77);
        tracer.intersect(rays.part(first, some), alone.span());
        tracer.occluded(rays.part(first, some), blocked_alone);
        for (std::size_t k = 0; k < some; ++k) {
            const std::size_t i = first + k;
            const bool same = together.t[i] == alone.t[k] && together.nx[i] == alone.nx[k] &&
                              together.ny[i] == alone.ny[k] && together.nz[i] == alone.nz[k] &&
                              together.shape[i] == alone.shape[k] &&
                              together.entering[i] == alone.entering[k] &&
                              blocked[i] == blocked_alone[k];
            different += same ? 0 : 1;
        }
    }
    return different;
}

} // namespace

TEST_CASE(
    "rays have the same answers in short calls and in one call where spheres nearly coincide") {
    Random random(8);
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    Rays rays;
    for (int i = 0; i < 300; ++i) {
        const Vec3 center{uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)};
        const float radius = uniform(random, 0.02, 0.05), other = std::nextafter(radius, 1.0F);
        builder.add(Sphere{center, i % 2 == 0 ? radius : other}, material);
        builder.add(Sphere{center, i % 2 == 0 ? other : radius}, material);
        rays.add({uniform(random, -1, 2), uniform(random, -1, 2), -2},
                 {uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), 1});
    }
    const Tracer tracer(builder.build(), {.threads = 1});
    CHECK(different_in_short_calls(tracer, rays, rays.size()) == 0);
    CHECK(different_in_short_calls(tracer, DoubleRays(rays), rays.size()) == 0);
}

TEST_CASE("refused rays are counted in calls of any length") {
    Rays rays;
    for (const float z : {-2.0F, not_a_number, -2.0F, -2.0F, -2.0F, -2.0F})
        rays.add({0, 0, z}, {0, 0, 1});
    rays.dz[2] = 0;
    rays.t_min = {0, 0, 0, not_a_number, 0, 3};
    rays.t_max = {infinity, infinity, infinity, infinity, not_a_number, 1};
    const Tracer tracer(ball());
    Hits hits(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    QueryStatistics statistics;
    const auto refused = [&](const RaySpan& asked) {
        const std::size_t count = asked.origin_x.size();
        tracer.occluded(asked, std::span(blocked).first(count), &statistics);
        const std::uint64_t of_occluded = statistics.refused;
        tracer.intersect(asked, HitSpan{.t = std::span(hits.t).first(count)}, &statistics);
        CHECK(statistics.refused == of_occluded);
        return statistics.refused;
    };
    CHECK(refused(rays.span()) == 4);
    for (std::size_t i = 0; i < rays.size(); ++i)
        CHECK(refused(rays.part(i, 1)) == (i == 0 || i == 5 ? 0 : 1));
}

TEST_CASE("hard rays have the same answers in short calls and in one call") {
    for (const bool lattice : {false, true}) {
        auto [scene, rays] = heap(lattice, 12, 3);
        const Tracer tracer(scene, {.threads = 1});
        const std::size_t count = rays.size();
        const Hits hits = intersect(tracer, rays);
        CAPTURE(lattice);
        CHECK(different_in_short_calls(tracer, rays, count) == 0);
        CHECK(different_in_short_calls(tracer, DoubleRays(rays), count) == 0);
        // Each limit is the t of a hit.
        rays.t_max = hits.t;
        CHECK(different_in_short_calls(tracer, rays, count) == 0);
        rays.t_max.clear();
        for (const float t : hits.t)
            rays.t_min.push_back(t < infinity ? t : 0.0F);
        CHECK(different_in_short_calls(tracer, rays, count) == 0);
    }
}

namespace {

/// Returns a scene of so many balls that rays in lines are reordered into tiles.
Scene many_balls() {
    Random random(7);
    SceneBuilder builder;
    const MaterialIndex material = builder.add_material({});
    for (int i = 0; i < 9000; ++i)
        builder.add(
            Sphere{{uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)}, 0.012F},
            material);
    return builder.build();
}

/// Returns rays line by line, from one point or parallel.
Rays lines(bool parallel, bool with_limits) {
    constexpr int width = 256, count = 9 * 1024 + 100; // the last ones in a separate block
    Rays rays;
    for (int i = 0; i < count; ++i) {
        const float x = static_cast<float>(i % width) / 256.0F,
                    y = static_cast<float>(i / width) / 40.0F;
        if (parallel)
            rays.add({x, y, 2.0F}, {0, 0.1F, -1});
        else
            rays.add({0.4F, 0.6F, 3.0F}, {x - 0.4F, y - 0.6F, i % 301 == 7 ? not_a_number : -2.5F});
        if (!with_limits) continue;
        rays.t_min.push_back(i % 3 == 0 ? 1.2F : 0.0F);
        rays.t_max.push_back(i % 7 == 0 ? 1.1F : 2.5F);
    }
    return rays;
}

} // namespace

TEST_CASE("rays line by line have the answers that they have alone") {
    const Tracer tracer(many_balls(), {.threads = 1});
    for (const bool parallel : {false, true})
        for (const bool with_limits : {false, true}) {
            const Rays rays = lines(parallel, with_limits);
            simd::TileOrder order; // must be found: otherwise this tests nothing
            const simd::RayStream<float> first = {simd::TileOrder::most,
                                                  {rays.x.data(), rays.y.data(), rays.z.data()},
                                                  {rays.dx.data(), rays.dy.data(), rays.dz.data()}};
            CHECK(order.find(first, parallel));

            const FullHits hits(tracer, rays);
            std::vector<std::uint8_t> blocked(rays.size(), 77);
            tracer.occluded(rays.span(), blocked);
            std::size_t found = 0, different = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                FullHits alone(1);
                tracer.intersect(rays.part(i, 1), alone.span());
                found += alone.is_none(0) ? 0 : 1;
                const bool same =
                    hits.is_same(i, alone, 0) && blocked[i] == (alone.is_none(0) ? 0 : 1);
                different += same ? 0 : 1;
            }
            CAPTURE(parallel, with_limits, found);
            CHECK(different == 0);
            CHECK(found > rays.size() / 4);
        }
}

TEST_CASE("rays are reordered into tiles where that makes packets more compact") {
    constexpr std::size_t count = simd::TileOrder::most;
    std::vector<float> u(count), v(count), one(count, 1.0F), none(count, 0.0F);
    const auto is_found = [&](auto&& point_of) {
        for (std::size_t i = 0; i < count; ++i)
            std::tie(u[i], v[i]) = point_of(static_cast<int>(i));
        simd::TileOrder order;
        const simd::RayStream<float> rays = {
            count, {none.data(), none.data(), none.data()}, {u.data(), v.data(), one.data()}};
        if (!order.find(rays, false)) return false;
        std::vector<std::uint32_t> indices(order.order().begin(), order.order().end());
        // Packets are squares of about 4 by 4.
        double rims = 0.0;
        for (std::size_t first = 0; first < count; first += 16)
            for (const std::vector<float>& values : {u, v}) {
                float low = infinity, high = -infinity;
                for (std::size_t k = first; k < first + 16; ++k) {
                    low = std::min(low, values[indices[k]]);
                    high = std::max(high, values[indices[k]]);
                }
                rims += static_cast<double>(high - low) * 512.0;
            }
        CHECK(rims / (count / 16) < 11.5); // a packet on a line has 15
        std::sort(indices.begin(), indices.end());
        for (std::uint32_t i = 0; i < count; ++i)
            CHECK(indices[i] == i);
        return true;
    };
    const auto at = [](int x, int y) {
        return std::pair(static_cast<float>(x) / 512.0F, static_cast<float>(y) / 512.0F);
    };
    CHECK(is_found([&](int i) { return at(i % 512, i / 512); }));
    CHECK(is_found([&](int i) { return at(i % 128, i / 128); }));
    CHECK(is_found([&](int i) { return at(i / 64, i % 64); }));
    CHECK_FALSE(is_found([&](int i) { // tiles of 16 x 16
        return at(i % 16 + i / 256 % 8 * 16, i / 16 % 16 + i / 2048 * 16);
    }));
    CHECK_FALSE(is_found([&](int i) { return at(i, 0); }));
    CHECK_FALSE(is_found([&](int) { return at(3, 5); }));
    CHECK_FALSE(is_found([&](int i) {
        return std::pair(i == 100 ? infinity : static_cast<float>(i % 512), not_a_number);
    }));
}

namespace {

/// Returns the surface that a ray starts on in core's terms.
core::OriginSurfaces<double> origin_on(const core::Scene& scene, const core::Hit<double>& hit,
                                       bool inward) {
    const core::Contact<double> surface{
        hit, scene.coplanar_with(hit.shape), 0, Vec3d(0.0), inward, inward};
    return core::OriginSurfaces<double>(std::span(&surface, 1));
}

/// Rays from the hits of other rays, reflected or straight on, and the surfaces that they leave.
struct Next {
    Rays rays;
    std::vector<core::Hit<double>> left;
    std::vector<ShapeId> shape;
    std::vector<std::uint8_t> face, inward;

    RaySpan span() const {
        RaySpan span = rays.span();
        span.origin_shape = shape;
        span.origin_face = face;
        span.origin_inward = inward;
        return span;
    }
};

Next rays_from(const core::Scene& scene, core::Searcher<double>& searcher, const Rays& rays) {
    Next next;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const core::Ray<double> ray = rays.ray(i);
        const auto hit =
            searcher.nearest(ray, {}, [](const core::Hit<double>&) { return true; }).hit;
        if (!hit.any()) continue;
        const Vec3d normal = core::convert<double>(core::rounded_normal(scene, {ray, {}}, hit));
        const Vec3f from = core::convert<float>(core::mul_add(hit.t, ray.direction, ray.origin));
        const bool through = i % 2 == 0;
        const Vec3f along = core::convert<float>(
            through ? ray.direction
                    : Vec3d(ray.direction - 2.0 * core::dot(ray.direction, normal) * normal));
        next.rays.add({from.x, from.y, from.z}, {along.x, along.y, along.z});
        next.left.push_back(hit);
        next.shape.push_back(hit.shape);
        next.face.push_back(hit.face);
        next.inward.push_back(through == hit.entering ? 1 : 0);
    }
    return next;
}

} // namespace

TEST_CASE("rays with an origin surface start on it") {
    for (const bool lattice : {false, true}) {
        const Heap setup = heap(lattice, 20, 11);
        const core::Scene& scene = library::Internals::of(setup.scene);
        core::Searcher<double> searcher(scene, core::Search::hierarchy);
        const Next next = rays_from(scene, searcher, setup.rays);
        const Tracer tracer(setup.scene);
        Hits hits(next.rays.size());
        std::vector<std::uint8_t> face(next.rays.size(), 77), blocked(next.rays.size(), 77);
        HitSpan span = hits.span();
        span.face = face;
        tracer.intersect(next.span(), span);
        tracer.occluded(next.span(), blocked);
        std::size_t wrong = 0, found = 0, own = 0;
        for (std::size_t i = 0; i < next.rays.size(); ++i) {
            const core::Ray<double> ray = next.rays.ray(i);
            const core::OriginSurfaces<double> origins =
                origin_on(scene, next.left[i], next.inward[i] != 0);
            const auto hit =
                searcher.nearest(ray, origins, [](const core::Hit<double>&) { return true; }).hit;
            if (blocked[i] != (hit.any() ? 1 : 0)) ++wrong;
            if (!hit.any()) {
                wrong += hits.is_none(i) && face[i] == 0 ? 0 : 1;
                continue;
            }
            ++found;
            own += hit.shape == next.shape[i] ? 1 : 0;
            const core::Vec3f normal = core::rounded_normal(scene, {ray, origins}, hit);
            const bool same = hits.shape[i] == hit.shape && face[i] == hit.face &&
                              hits.t[i] == core::rounded_t(scene, {ray, origins}, hit, 0) &&
                              hits.nx[i] == normal.x && hits.ny[i] == normal.y &&
                              hits.nz[i] == normal.z && hits.entering[i] == (hit.entering ? 1 : 0);
            wrong += same ? 0 : 1;
        }
        CAPTURE(lattice, next.rays.size(), found, own);
        CHECK(wrong == 0);
        CHECK(found > next.rays.size() / 4);
        CHECK(own > found / 20); // rays that leave the shape that they entered
    }
}

TEST_CASE("an origin surface that is not a shape of the scene has no effect") {
    const Tracer tracer(ball());
    Rays rays;
    for (int i = 0; i < 3; ++i)
        rays.add({0, 0, -1}, {0, 0, 1});
    const std::vector<ShapeId> shape = {no_shape, 7, 0};
    const std::vector<std::uint8_t> inward = {1, 1, 1};
    RaySpan span = rays.span();
    span.origin_shape = shape;
    Hits hits(3);
    tracer.intersect(span, hits.span());
    CHECK(hits.shape == std::vector<ShapeId>{0, 0, 0}); // the direction of the last one goes inside
    span.origin_inward = inward;
    tracer.intersect(span, hits.span());
    CHECK(hits.shape == std::vector<ShapeId>{0, 0, 0});
    CHECK(hits.t == std::vector<float>{2, 2, 2});
    const std::vector<ShapeId> few = {0, 0};
    span.origin_shape = few;
    CHECK_THROWS_AS(tracer.intersect(span, hits.span()), InvalidValue);
}
