#include "core/reference/search.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/scenes/files/message_of.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <set>

using namespace raylane;
using namespace raylane::tests;

TEST_CASE("the nearest crossings are those of a brute-force search") {
    for (const bool lattice : {false, true}) {
        const Heap setup = heap(lattice, 20, 7);
        const Hits hits = intersect(Tracer(setup.scene), setup.rays);
        core::Searcher<double> searcher(library::Internals::of(setup.scene),
                                        core::Search::every_shape);
        std::size_t wrong = 0, found = 0;
        for (std::size_t i = 0; i < setup.rays.size(); ++i) {
            const core::Ray<double> ray = setup.rays.ray(i);
            const auto hit =
                searcher.nearest(ray, {}, [](const core::Hit<double>&) { return true; }).hit;
            if (!hit.any()) {
                wrong += hits.is_none(i) ? 0 : 1;
                continue;
            }
            ++found;
            const core::Scene& scene = library::Internals::of(setup.scene);
            const core::Vec3f normal = core::rounded_normal(scene, {ray, {}}, hit);
            const bool same = hits.shape[i] == hit.shape &&
                              hits.t[i] == core::rounded_t(scene, {ray, {}}, hit, 0) &&
                              hits.nx[i] == normal.x && hits.ny[i] == normal.y &&
                              hits.nz[i] == normal.z && hits.entering[i] == (hit.entering ? 1 : 0);
            wrong += same ? 0 : 1;
        }
        CHECK(wrong == 0);
        CHECK(found > setup.rays.size() / 2);
    }
}

TEST_CASE("a ray with a hit's t as t_min finds the next crossing") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    core::Searcher<double> searcher(library::Internals::of(setup.scene), core::Search::every_shape);
    std::vector<std::set<float>> expected(setup.rays.size()), found(setup.rays.size());
    for (std::size_t i = 0; i < setup.rays.size(); ++i) {
        const core::Ray<double> ray = setup.rays.ray(i);
        searcher.each(ray, {}, std::numeric_limits<double>::infinity(),
                      [&](const core::Hit<double>& hit) {
                          expected[i].insert(core::rounded_t(library::Internals::of(setup.scene),
                                                             {ray, {}}, hit, 0));
                          return true;
                      });
    }
    Rays rays = setup.rays;
    rays.t_min.assign(rays.size(), 0.0F);
    for (bool any = true; any;) {
        any = false;
        const Hits hits = intersect(tracer, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (hits.shape[i] != no_shape) {
                any = true;
                CHECK(hits.t[i] > rays.t_min[i]);
                found[i].insert(hits.t[i]);
            }
            rays.t_min[i] = hits.t[i];
        }
    }
    for (std::size_t i = 0; i < rays.size(); ++i)
        CHECK(found[i] == expected[i]);
}

TEST_CASE("the range of t includes t_max and excludes t_min") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    const Hits hits = intersect(tracer, setup.rays);
    Rays rays = setup.rays;
    rays.t_max = hits.t;
    CHECK(intersect(tracer, rays) == hits);
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays.t_max[i] = std::nextafter(hits.t[i], 0.0F);
    const Hits before = intersect(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
        CHECK(before.is_none(i));

    rays = to_ball();
    rays.t_min = {4.0F};
    CHECK(intersect(Tracer(ball()), rays).t[0] == 6.0F);
    rays.t_max = {6.0F};
    CHECK(intersect(Tracer(ball()), rays).t[0] == 6.0F);
    rays.t_min = {6.0F};
    CHECK(intersect(Tracer(ball()), rays).is_none(0));
    rays.t_min = {-1.0F};
    CHECK(intersect(Tracer(ball()), rays).t[0] == 4.0F);
    for (const float t_max : {0.0F, -1.0F, -infinity}) {
        rays.t_max = {t_max};
        CHECK(intersect(Tracer(ball()), rays).is_none(0));
    }
}

TEST_CASE("a ray is occluded where intersect finds a shape") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    Rays rays = setup.rays;
    const auto check = [&] {
        const Hits hits = intersect(tracer, rays);
        const std::vector<std::uint8_t> blocked = occluded(tracer, rays);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            wrong += blocked[i] == (hits.shape[i] != no_shape ? 1 : 0) ? 0 : 1;
        CHECK(wrong == 0);
    };
    check();
    Random random(3);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays.t_min.push_back(static_cast<float>(random.uniform(-1.0, 5.0)));
        rays.t_max.push_back(static_cast<float>(random.uniform(0.0, 20.0)));
    }
    check();
    rays.t_min = intersect(tracer, setup.rays).t;
    rays.t_max.clear();
    check();
}

TEST_CASE("directions may have any length") {
    const Heap setup = heap();
    const Tracer tracer(setup.scene);
    const Hits hits = intersect(tracer, setup.rays);
    for (const int power : {-40, -1, 3, 50}) {
        Rays rays = setup.rays;
        for (std::vector<float>* components : {&rays.dx, &rays.dy, &rays.dz})
            for (float& value : *components)
                value = std::ldexp(value, power);
        Hits scaled = intersect(tracer, rays);
        CHECK(scaled.shape == hits.shape);
        for (float& t : scaled.t)
            t = std::ldexp(t, power);
        CHECK(scaled == hits);
    }
}

TEST_CASE("a t outside of the range of floats becomes the smallest or the largest one") {
    Rays rays;
    rays.add({0, 0, 5}, {0, 0, -std::numeric_limits<float>::denorm_min()});
    rays.add({0, 0, 1 + 0x1p-20F}, {0, 0, -std::numeric_limits<float>::max()});
    rays.add({0, 0, 1e-30F}, {0, 0, -std::numeric_limits<float>::max()});
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    builder.add(Sphere{{0, 0, 0}, 1}, m);
    builder.add(Plane{{0, 0, 0}, {0, 0, 1}}, m);
    const Hits hits = intersect(Tracer(builder.build()), rays);
    CHECK(hits.t[0] == std::numeric_limits<float>::max());
    CHECK(hits.shape[0] == 0);
    CHECK(hits.t[1] == 2 * std::numeric_limits<float>::denorm_min());
    CHECK(hits.shape[1] == 0);
    CHECK(hits.t[2] == std::numeric_limits<float>::denorm_min());
    CHECK(hits.shape[2] == 1);
    rays.t_max.assign(3, std::numeric_limits<float>::max());
    CHECK(occluded(Tracer(ball()), rays) == std::vector<std::uint8_t>{1, 1, 1});
}

TEST_CASE("a hit has the outward normal from either side") {
    Rays rays = to_ball();
    rays.add({0, 0, 0}, {0, 0, -2});
    const Hits hits = intersect(Tracer(ball()), rays);
    CHECK(hits.nz == std::vector<float>{1.0F, -1.0F});
    CHECK(hits.t[1] == 0.5F);
}

TEST_CASE("of coincident surfaces the entered one comes first and then the lower id") {
    SceneBuilder builder;
    const MaterialIndex m = builder.add_material({});
    const auto block = [&](float z) {
        return builder.add(Box{{-1, -1, z}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}}, m);
    };
    const ShapeId above = block(0.0F), below = block(-1.0F);
    block(-1.0F);
    Rays rays;
    rays.add({0.25F, 0.25F, 0.5F}, {0, 0, -1});
    const Tracer tracer(builder.build());
    CHECK(intersect(tracer, rays).shape[0] == below);
    rays.z[0] = -0.5F;
    rays.dz[0] = 1;
    CHECK(intersect(tracer, rays).shape[0] == above);
    rays.t_min = {0.5F};
    CHECK(intersect(tracer, rays).t[0] == 1.5F);
}

TEST_CASE("invisible sides are not hit and glass is") {
    const auto hits = [](const Material& material) {
        Rays rays = to_ball();
        rays.add({0, 0, 0}, {0, 0, 1});
        const Tracer tracer(ball(material));
        const std::vector<std::uint8_t> blocked = occluded(tracer, rays);
        CHECK(blocked == std::vector<std::uint8_t>{1, blocked[1]});
        CHECK((intersect(tracer, rays).t[1] == 1.0F) == (blocked[1] == 1));
        return intersect(tracer, rays).t[0];
    };
    CHECK(hits({}) == 4.0F);
    CHECK(hits({.transmission = 1.0F}) == 4.0F);
    CHECK(hits({.visible = Visible::outside}) == 4.0F);
    CHECK(hits({.visible = Visible::inside}) == 6.0F);
}

TEST_CASE("a ray hits nothing in a scene without shapes") {
    const Tracer tracer(SceneBuilder().build());
    CHECK(intersect(tracer, to_ball()).is_none(0));
    CHECK(occluded(tracer, to_ball())[0] == 0);
}

TEST_CASE("other precisions answer nearly the same") {
    const Heap setup = heap(false, 20, 7);
    const Hits expected = intersect(Tracer(setup.scene), setup.rays);
    for (const Precision precision :
         {Precision::fast, Precision::robust, Precision::plain_double}) {
        const Tracer tracer(setup.scene, {.precision = precision});
        const Hits hits = intersect(tracer, setup.rays);
        std::size_t other = 0, not_equal = 0;
        for (std::size_t i = 0; i < setup.rays.size(); ++i) {
            const bool same = hits.shape[i] == expected.shape[i];
            other += same && (hits.is_none(i) || std::abs(hits.t[i] / expected.t[i] - 1.0F) < 1e-3F)
                         ? 0
                         : 1;
            not_equal += hits.t[i] == expected.t[i] ? 0 : 1;
        }
        CAPTURE(static_cast<int>(precision), other, not_equal, setup.rays.size());
        CHECK(other < setup.rays.size() / 5);
        if (precision != Precision::plain_double) CHECK(not_equal > 0);
    }
    CHECK(message_of<InvalidValue>([&] {
              Tracer(setup.scene, {.precision = static_cast<Precision>(4)});
          }) == "precision: must be a Precision");
}
