#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/support/catch.hpp"

#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

using namespace raylane;
using namespace raylane::tests;

TEST_CASE("answers depend on the ray alone and not on the length of the span") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene), one_thread(setup.scene, {.threads = 1}),
        many_threads(setup.scene, {.threads = 5});
    const Hits hits_of_all = intersect(tracer, setup.rays);
    CHECK(intersect(one_thread, setup.rays) == hits_of_all);
    CHECK(intersect(many_threads, setup.rays) == hits_of_all);
    const std::vector<std::uint8_t> blocked = occluded(tracer, setup.rays);
    CHECK(occluded(one_thread, setup.rays) == blocked);
    CHECK(occluded(many_threads, setup.rays) == blocked);
    for (const std::size_t length : {1, 17, 300, 1000}) {
        Hits parts(setup.rays.size());
        std::vector<std::uint8_t> blocked_parts(setup.rays.size());
        for (std::size_t first = 0; first < setup.rays.size(); first += length) {
            const std::size_t count = std::min(length, setup.rays.size() - first);
            const auto part_of = [&](auto& values) {
                return std::span(values).subspan(first, count);
            };
            tracer.intersect(setup.rays.part(first, count),
                             {part_of(parts.t), part_of(parts.nx), part_of(parts.ny),
                              part_of(parts.nz), part_of(parts.shape), part_of(parts.entering)});
            tracer.occluded(setup.rays.part(first, count), part_of(blocked_parts));
        }
        CHECK(parts == hits_of_all);
        CHECK(blocked_parts == blocked);
    }
}

TEST_CASE("a call without rays gives no answers") {
    const Tracer tracer(ball());
    tracer.intersect(RaySpan{}, {});
    tracer.occluded(RaySpan{}, {});
    CHECK(intersect(tracer, {}).t.empty());
}

TEST_CASE("outputs that are not wanted may be omitted") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    const Hits hits_of_all = intersect(tracer, setup.rays);
    Hits hits(setup.rays.size());
    tracer.intersect(setup.rays.span(), {.t = hits.t});
    tracer.intersect(setup.rays.span(), {.normal_x = hits.nx});
    tracer.intersect(setup.rays.span(), {.normal_y = hits.ny});
    tracer.intersect(setup.rays.span(), {.normal_z = hits.nz});
    tracer.intersect(setup.rays.span(), {.shape_id = hits.shape});
    tracer.intersect(setup.rays.span(), {.entering = hits.entering});
    tracer.intersect(setup.rays.span(), {});
    CHECK(hits == hits_of_all);
}

TEST_CASE("a span of the wrong length is refused with its name") {
    const Tracer tracer(ball());
    const std::vector<float> two(2, 1.0F), three(3, 1.0F);
    std::vector<float> out(3);
    std::vector<ShapeId> ids(3);
    std::vector<std::uint8_t> flags(3);
    const auto refused = [](const auto& act) {
        try {
            act();
        } catch (const std::invalid_argument& error) {
            const auto& invalid = dynamic_cast<const InvalidValue&>(error);
            CHECK(std::string(error.what()) == invalid.field + ": " + invalid.expectation);
            return invalid.field;
        }
        return std::string("not refused");
    };
    const RaySpan good{two, two, two, two, two, two};
    using Input = std::span<const float> RaySpan::*;
    const std::pair<Input, const char*> inputs[] = {{&RaySpan::origin_y, "origin_y"},
                                                    {&RaySpan::origin_z, "origin_z"},
                                                    {&RaySpan::direction_x, "direction_x"},
                                                    {&RaySpan::direction_y, "direction_y"},
                                                    {&RaySpan::direction_z, "direction_z"},
                                                    {&RaySpan::t_min, "t_min"},
                                                    {&RaySpan::t_max, "t_max"}};
    for (const auto& [input, name] : inputs) {
        RaySpan rays = good;
        rays.*input = three;
        CHECK(refused([&] { tracer.intersect(rays, {}); }) == name);
        CHECK(refused([&] { tracer.occluded(rays, std::span(flags).first(2)); }) == name);
    }
    RaySpan without = good;
    without.direction_z = {};
    CHECK(refused([&] { tracer.intersect(without, {}); }) == "direction_z");
    CHECK(refused([&] { tracer.intersect({.t_max = two}, {}); }) == "t_max");

    CHECK(refused([&] { tracer.intersect(good, {.t = out}); }) == "t");
    CHECK(refused([&] { tracer.intersect(good, {.normal_x = out}); }) == "normal_x");
    CHECK(refused([&] { tracer.intersect(good, {.normal_y = out}); }) == "normal_y");
    CHECK(refused([&] { tracer.intersect(good, {.normal_z = out}); }) == "normal_z");
    CHECK(refused([&] { tracer.intersect(good, {.shape_id = ids}); }) == "shape_id");
    CHECK(refused([&] { tracer.occluded(good, flags); }) == "occluded");
    CHECK(refused([&] { tracer.occluded(good, {}); }) == "occluded");
    try {
        tracer.intersect(good, {.t = out});
    } catch (const InvalidValue& invalid) {
        CHECK(invalid.expectation == "must have one element for each of 2 rays, got 3");
    }
    CHECK(refused([] { Tracer(ball(), {.threads = 4097}); }) == "threads");
}

TEST_CASE("an invalid ray hits nothing and does not affect other rays") {
    const Tracer tracer(ball());
    Rays rays;
    const float bad[] = {not_a_number, infinity, -infinity};
    const auto good = [&] { rays.add({0, 0, 5}, {0, 0, -1}); };
    for (const float value : bad) {
        rays.add({value, 0, 5}, {0, 0, -1});
        rays.add({0, value, 5}, {0, 0, -1});
        rays.add({0, 0, value}, {0, 0, -1});
        rays.add({0, 0, 5}, {value, 0, -1});
        rays.add({0, 0, 5}, {0, value, -1});
        rays.add({0, 0, 5}, {0, 0, value});
        good();
    }
    rays.add({0, 0, 5}, {0, 0, 0});
    rays.add({0, 0, 0}, {-0.0F, 0, -0.0F});
    good();
    const Hits hits = intersect(tracer, rays);
    const std::vector<std::uint8_t> blocked = occluded(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool is_good = rays.z[i] == 5.0F && rays.x[i] == 0.0F && rays.y[i] == 0.0F &&
                             rays.dx[i] == 0.0F && rays.dy[i] == 0.0F && rays.dz[i] == -1.0F;
        CHECK(hits.is_none(i) == !is_good);
        CHECK(blocked[i] == (is_good ? 1 : 0));
    }

    for (const float value : {not_a_number, infinity}) {
        Rays limited = to_ball();
        limited.t_min = {value};
        CHECK(intersect(tracer, limited).is_none(0));
    }
    Rays limited = to_ball();
    limited.t_max = {not_a_number};
    CHECK(intersect(tracer, limited).is_none(0));
    CHECK(occluded(tracer, limited)[0] == 0);
}

TEST_CASE("a tracer keeps its scene alive and a copy gives the same answers") {
    const Tracer tracer = [] {
        const Tracer first(ball());
        return Tracer(first); // NOLINT: a copy
    }();
    CHECK(tracer.scene().shape_count() == 1);
    CHECK(intersect(tracer, to_ball()).t[0] == 4.0F);
}

TEST_CASE("any number of threads may ask one tracer") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    const Hits hits_of_all = intersect(tracer, setup.rays);
    const std::vector<std::uint8_t> blocked = occluded(tracer, setup.rays);
    std::vector<Hits> hits(6, Hits(setup.rays.size()));
    std::vector<std::vector<std::uint8_t>> flags(hits.size(),
                                                 std::vector<std::uint8_t>(setup.rays.size()));
    {
        std::vector<std::jthread> threads;
        for (std::size_t k = 0; k < hits.size(); ++k)
            threads.emplace_back([&, k] {
                tracer.intersect(setup.rays.span(), hits[k].span());
                tracer.occluded(setup.rays.span(), flags[k]);
            });
    }
    for (std::size_t k = 0; k < hits.size(); ++k) {
        CHECK(hits[k] == hits_of_all);
        CHECK(flags[k] == blocked);
    }
}
