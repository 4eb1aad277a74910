#include "core/reference/search.hpp"
#include "scenes/api/cpp/internals.hpp"
#include "tests/scenes/api/ray_arrays.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

/// Tests of ray limits with the precisions that are not certified. An exact brute-force search
/// gives the truth. Each precision must find it where it is so clear that no rounding can hide it.
using namespace raylane;
using namespace raylane::tests;

namespace {

constexpr Precision not_certified[] = {Precision::fast, Precision::robust, Precision::plain_double};

Heap heap_of(const Material& material) {
#ifdef RAYLANE_FEW_RAYS
    constexpr int of_each_kind = 3;
#else
    constexpr int of_each_kind = 14;
#endif
    Heap setup = heap(false, of_each_kind, 11, material);
    Random random(3);
    for (std::size_t i = 0; i < setup.rays.size(); ++i) {
        const bool from_start = random.integer(0, 2) == 0;
        const bool without_end = random.integer(0, 2) == 0;
        setup.rays.t_min.push_back(from_start ? 0.0F
                                              : static_cast<float>(random.uniform(-1.0, 9.0)));
        setup.rays.t_max.push_back(without_end ? infinity
                                               : static_cast<float>(random.uniform(0.0, 30.0)));
    }
    return setup;
}

class BruteForce {
  public:
    explicit BruteForce(const Heap& setup)
        : scene_(library::Internals::of(setup.scene)), rays_(setup.rays),
          searcher_(scene_, core::Search::every_shape) {}

    /// Returns the nearest hit between a ray's limits if all neighbouring rays hit the same shape
    /// at about the same t, or all of them nothing; otherwise nothing. Some neighbours are closer
    /// than others, as shapes may be small.
    std::optional<core::Hit<double>> clear_answer(std::size_t i) {
        const core::Hit<double> hit = nearest(i, rays_.ray(i), 1.0);
        Random random(i);
        for (int neighbour = 0; neighbour < 16; ++neighbour) {
            const double blur = std::ldexp(1.0, -8 - 4 * (neighbour % 4));
            core::Ray<double> ray = rays_.ray(i);
            ray.origin += random.cube(blur * (1.0 + core::length(ray.origin)));
            ray.direction += random.cube(blur * core::length(ray.direction));
            const core::Hit<double> near =
                nearest(i, ray, neighbour % 2 == 0 ? 1.0 - blur : 1.0 + blur);
            if (near.shape != hit.shape || std::abs(near.t - hit.t) > 0.25 * hit.t)
                return std::nullopt;
        }
        return hit;
    }

  private:
    core::Hit<double> nearest(std::size_t i, const core::Ray<double>& ray, double grown) {
        const double t_min = std::max(0.0, static_cast<double>(rays_.t_min[i]) * grown);
        const double t_max = static_cast<double>(rays_.t_max[i]) * grown;
        core::Hit<double> first;
        searcher_.each(ray, {}, std::numeric_limits<double>::infinity(),
                       [&](const core::Hit<double>& hit) {
                           if (hit.t > t_min && hit.t <= t_max && hit.t < first.t &&
                               scene_.material_of(hit.shape).is_seen(hit.entering))
                               first = hit;
                           return true;
                       });
        return first;
    }

    const core::Scene& scene_;
    const Rays& rays_;
    core::Searcher<double> searcher_;
};

const Material materials[] = {
    {}, {.transmission = 1.0F}, {.visible = Visible::inside}, {.visible = Visible::outside}};

} // namespace

TEST_CASE("every precision finds clear hits between a ray's limits") {
    for (const Material& material : materials) {
        const Heap setup = heap_of(material);
        BruteForce brute_force(setup);
        std::vector<std::optional<core::Hit<double>>> expected;
        std::size_t clear = 0, clear_hits = 0;
        for (std::size_t i = 0; i < setup.rays.size(); ++i) {
            expected.push_back(brute_force.clear_answer(i));
            clear += expected[i] ? 1 : 0;
            clear_hits += expected[i] && expected[i]->any() ? 1 : 0;
        }
        CHECK(clear > setup.rays.size() / 2);
        CHECK(clear_hits > setup.rays.size() / 6);

        for (const Precision precision : not_certified) {
            const Tracer tracer(setup.scene, {.precision = precision});
            const Hits hits = intersect(tracer, setup.rays);
            const std::vector<std::uint8_t> blocked = occluded(tracer, setup.rays);
            std::size_t wrong = 0, wrongly_blocked = 0, out_of_limits = 0;
            for (std::size_t i = 0; i < setup.rays.size(); ++i) {
                out_of_limits +=
                    hits.is_none(i) ||
                            (hits.t[i] > std::max(0.0F, setup.rays.t_min[i]) &&
                             hits.t[i] <= setup.rays.t_max[i] && hits.shape[i] != no_shape)
                        ? 0
                        : 1;
                if (!expected[i]) continue;
                const core::Hit<double>& hit = *expected[i];
                const bool same = hits.shape[i] == hit.shape &&
                                  (!hit.any() || std::abs(static_cast<double>(hits.t[i]) / hit.t -
                                                          1.0) < 0x1p-10);
                wrong += same ? 0 : 1;
                wrongly_blocked += blocked[i] == (hit.any() ? 1 : 0) ? 0 : 1;
            }
            CAPTURE(static_cast<int>(precision), clear, clear_hits);
            // The neighbours may miss a close call, and textbook formulas lose rays nearly parallel
            // to a cone's side: 1 and 3 of some 750 were measured.
            const std::size_t most = precision == Precision::fast     ? 1 + clear / 100
                                     : precision == Precision::robust ? 1 + clear / 300
                                                                      : 0;
            CHECK(wrong <= most);
            CHECK(wrongly_blocked <= most);
            CHECK(out_of_limits == 0);
        }
    }
}

TEST_CASE("rays with each t as the next t_min advance and end with every precision") {
    const Heap setup = heap_of({});
    for (const Precision precision : not_certified) {
        const Tracer tracer(setup.scene, {.precision = precision});
        Rays rays = setup.rays;
        rays.t_min.assign(rays.size(), 0.0F);
        rays.t_max.clear();
        std::size_t steps = 0, not_behind = 0;
        for (bool any = true; any; ++steps) {
            // A ray crosses each shape at most once on its way in and once on its way out.
            REQUIRE(steps <= 2 * setup.scene.shape_count() + 1);
            any = false;
            const Hits hits = intersect(tracer, rays);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                any = any || hits.shape[i] != no_shape;
                not_behind += hits.is_none(i) || hits.t[i] > rays.t_min[i] ? 0 : 1;
            }
            rays.t_min = hits.t;
        }
        CHECK(not_behind == 0);
        CHECK(steps > 4);
    }
}
