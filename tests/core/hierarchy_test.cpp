#include "tests/support/catch.hpp"
#include "tests/support/little_scene.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/rounds.hpp"

using namespace little_scene;
using namespace raylane;
using ray_sets::Random;
using ray_sets::Set;

namespace {

struct Aimed {
    Scene scene;
    std::vector<Ray<double>> rays;
};

template <class Shape>
void add_kind(Builder& builder, MaterialIndex material, int count, bool lattice, Random& random,
              std::vector<Ray<double>>& rays) {
    for (int i = 0; i < count; ++i) {
        const Shape shape = ray_sets::Target<Shape>::make(random, lattice);
        builder.add(shape, material);
        for (const Set set : ray_sets::all_sets) {
            if ((set == Set::lattice) != lattice) continue;
            const Ray<float> ray = ray_sets::make_ray(shape, set, random);
            rays.push_back({convert<double>(ray.origin), convert<double>(ray.direction)});
        }
    }
}

/// Returns a heap of shapes of all kinds, with rays that are hard for some of them.
Aimed heap(bool lattice, int of_each_kind, std::uint64_t seed) {
    Random random(seed);
    Builder builder;
    std::vector<Ray<double>> rays;
    const MaterialIndex material = builder.add_material(luminous());
    for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
        const int count = tests::is_bounded<Shape> ? of_each_kind : 2;
        add_kind<Shape>(builder, material, count, lattice, random, rays);
    });
    return {builder.finish(), rays};
}

bool crosses(Searcher<double>& searcher, const Ray<double>& ray, double t_limit) {
    bool found = false;
    searcher.each(ray, OriginSurfaces<double>{}, t_limit, [&](const Hit<double>&) {
        found = true;
        return false;
    });
    return found;
}

bool same(const Hit<double>& a, const Hit<double>& b) {
    return a.t == b.t && a.shape == b.shape && a.face == b.face && a.entering == b.entering;
}

} // namespace

TEST_CASE("the hierarchy finds the same hits in a heap of all kinds as brute force") {
    for (const bool lattice : {false, true})
        for (const int of_each_kind : {1, 40, 100}) {
            if (of_each_kind == 100 && !tests::is_full())
                continue; // takes a minute with sanitizers
            const Aimed aimed = heap(lattice, of_each_kind, 20 + of_each_kind);
            Searcher<double> by_hierarchy(aimed.scene, Search::hierarchy);
            Searcher<double> by_trying(aimed.scene, Search::every_shape);
            const auto any_hit = [](const Hit<double>&) { return true; };
            int hits = 0, lost = 0, blocked_otherwise = 0;
            for (const Ray<double>& ray : aimed.rays) {
                const Hit<double> hit =
                    by_trying.nearest(ray, OriginSurfaces<double>{}, any_hit).hit;
                hits += hit.any() ? 1 : 0;
                if (!same(hit, by_hierarchy.nearest(ray, OriginSurfaces<double>{}, any_hit).hit))
                    ++lost;
                // The ray crosses nothing before the hit, and something just beyond it.
                const double off = 2.0 * needed_accuracy * hit.t;
                if (crosses(by_hierarchy, ray, hit.any() ? hit.t - off : hit.t))
                    ++blocked_otherwise;
                if (hit.any() && !crosses(by_hierarchy, ray, hit.t + off)) ++blocked_otherwise;
            }
            CAPTURE(lattice, of_each_kind);
            CHECK(lost == 0);
            CHECK(blocked_otherwise == 0);
            CHECK(hits > static_cast<int>(aimed.rays.size()) / 3);
            if (of_each_kind == 100)
                // Blocks of 16 are full, whatever is in a heap that fills its box many times.
                CHECK(by_hierarchy.counters.shapes < by_trying.counters.shapes * 3 / 5);
        }
}

TEST_CASE("the first added of the shapes at one distance is hit") {
    const Sphere sphere{{0, 0, 0}, 1};
    Builder builder;
    for (int copy = 0; copy < 40; ++copy)
        builder.add_shape(sphere, luminous());
    const Scene scene = builder.finish();
    for (const Search search : {Search::hierarchy, Search::every_shape}) {
        Searcher<double> searcher(scene, search);
        const auto any_hit = [](const Hit<double>&) { return true; };
        const Ray<double> ray{{0, 0, 5}, {0, 0, -1}};
        CHECK(searcher.nearest(ray, OriginSurfaces<double>{}, any_hit).hit.shape == 0);
        const auto but_the_first = [](const Hit<double>& hit) { return hit.shape > 0; };
        CHECK(searcher.nearest(ray, OriginSurfaces<double>{}, but_the_first).hit.shape == 1);
    }
}

TEST_CASE("a ray in the plane of a node's face loses no hit") {
    // Zero and denormal components: 0 * inf, or the inverse of a denormal, must not decide.
    Builder builder;
    for (int i = 0; i < 100; ++i)
        builder.add_shape(Box{{static_cast<float>(2 * i), 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                          luminous());
    const Scene scene = builder.finish();
    Searcher<double> by_hierarchy(scene, Search::hierarchy);
    Searcher<double> by_trying(scene, Search::every_shape);
    const auto any_hit = [](const Hit<double>&) { return true; };
    for (const double y : {0.0, 1.0, 0.5})
        for (const double dy : {0.0, -0.0, 1e-45, -1e-45, 4e-324, -4e-324})
            for (const double dx : {1.0, -1.0}) {
                const Ray<double> ray{{dx > 0 ? -1.0 : 300.0, y, 0.5}, {dx, dy, 0.0}};
                const Hit<double> hit =
                    by_hierarchy.nearest(ray, OriginSurfaces<double>{}, any_hit).hit;
                CAPTURE(y, dy, dx);
                CHECK(same(hit, by_trying.nearest(ray, OriginSurfaces<double>{}, any_hit).hit));
                if (dy == 0.0) CHECK(hit.shape == (dx > 0 ? 0U : 99U));
            }
}
