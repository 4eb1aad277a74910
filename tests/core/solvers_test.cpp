#include "core/shapes/shapes.hpp"
#include "core/shapes/solve.hpp"
#include "tests/oracle/first_hit.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/rounds.hpp"

#include <cmath>
#include <cstring>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;
using ray_sets::Set;

namespace {

/// Returns the number of steps between two floats in the order of all floats.
std::int64_t ulps_between(float a, float b) {
    const auto rank = [](float f) {
        std::int32_t bits = 0;
        std::memcpy(&bits, &f, sizeof bits);
        return bits < 0 ? std::int64_t{std::numeric_limits<std::int32_t>::min()} - bits
                        : std::int64_t{bits};
    };
    return std::abs(rank(a) - rank(b));
}

template <class Real>
const Crossing<Real>* first_ahead(const Crossings<Real>& crossings) {
    for (const Crossing<Real>& crossing : crossings)
        if (crossing.t > Real(0)) return &crossing;
    return nullptr;
}

template <class Real>
Ray<Real> widened(const Ray<float>& ray) {
    return {convert<Real>(ray.origin), convert<Real>(ray.direction)};
}

struct Tally {
    int rays = 0, hits = 0, wrong = 0;
    std::int64_t worst_ulps = 0;
    std::uint64_t widened = 0;
};

/// Compares the double solver's first crossing ahead with the oracle's.
template <class Shape>
void compare(const Shape& shape, const Ray<float>& ray, Tally& tally) {
    const auto truth = oracle::first_hit(shape, ray);
    const Crossings<double> crossings = solve(shape, widened<double>(ray), Start{}, tally.widened);
    const Crossing<double>* found = first_ahead(crossings);

    ++tally.rays;
    tally.hits += truth.has_value() ? 1 : 0;
    const bool wrong =
        truth.has_value() != (found != nullptr) || (truth && truth->entering != found->entering);
    if (truth && found) {
        const std::int64_t ulps =
            ulps_between(static_cast<float>(found->t), truth->t.template convert_to<float>());
        tally.worst_ulps = std::max(tally.worst_ulps, ulps);
    }
    if (wrong && tally.wrong++ < 3) {
        UNSCOPED_INFO("origin " << ray.origin.x << ' ' << ray.origin.y << ' ' << ray.origin.z
                                << " direction " << ray.direction.x << ' ' << ray.direction.y << ' '
                                << ray.direction.z << (truth ? " misses " : " hits ")
                                << name_of(kind_of<Shape>));
    }
}

// Sanitizers slow the oracle down ten times and look for other things.
const int rays_per_set = tests::fixed_rounds(4'000, 1'500, 15'000);
constexpr int rays_per_shape = 10;

} // namespace

TEMPLATE_TEST_CASE("the double reference decides as the oracle does", "", RAYLANE_ALL_SHAPES) {
    using Shape = TestType;
    Random random(20260000 + static_cast<int>(kind_of<Shape>));
    for (const Set set : ray_sets::all_sets) {
        Tally tally;
        for (int i = 0; i < rays_per_set / rays_per_shape; ++i) {
            const Shape shape = ray_sets::Target<Shape>::make(random, set == Set::lattice);
            for (int j = 0; j < rays_per_shape; ++j)
                compare(shape, ray_sets::make_ray(shape, set, random), tally);
        }
        INFO(name_of(kind_of<Shape>)
             << ", " << ray_sets::set_names[static_cast<int>(set)] << ": " << tally.rays
             << " rays, " << tally.hits << " hits, " << tally.widened << " widened");
        CHECK(tally.wrong == 0);
        CHECK(tally.worst_ulps <= 1);
        CHECK(tally.hits > tally.rays / 100); // otherwise the set tests nothing
    }
}

TEMPLATE_TEST_CASE("the same formulas in the oracle's numbers agree with the oracle", "",
                   RAYLANE_ALL_SHAPES) {
    using Shape = TestType;
    using oracle::Number;
    Random random(20260100 + static_cast<int>(kind_of<Shape>));
    int compared = 0;
    for (int i = 0; i < 1000; ++i) {
        const Shape shape = ray_sets::Target<Shape>::make(random, false);
        const Ray<float> ray = ray_sets::make_ray(shape, Set::random, random);
        ErrorPredicate<Number> predicate;
        const Crossings<Number> solved = crossings(shape, widened<Number>(ray), Start{}, predicate);
        const Crossing<Number>* found = first_ahead(solved);
        const auto truth = oracle::first_hit(shape, ray);
        REQUIRE(truth.has_value() == (found != nullptr));
        if (!truth) continue;
        ++compared;
        CHECK(abs(found->t - truth->t) <= truth->t * Number("1e-70"));
    }
    CHECK(compared > 30);
}

// The reason why the double reference checks its own error: without that, even simple coordinates
// mislead it.
TEMPLATE_TEST_CASE("double without error bounds decides wrongly", "", Sphere, CappedCylinder,
                   CappedCone) {
    using Shape = TestType;
    Random random(20260200 + static_cast<int>(kind_of<Shape>));
    int wrong = 0;
    for (int i = 0; i < 5000; ++i) {
        const Shape shape = ray_sets::Target<Shape>::make(random, true);
        const Ray<float> ray = ray_sets::make_ray(shape, Set::lattice, random);
        ErrorPredicate<double> predicate;
        const Crossings<double> found = crossings(shape, widened<double>(ray), Start{}, predicate);
        wrong +=
            oracle::first_hit(shape, ray).has_value() != (first_ahead(found) != nullptr) ? 1 : 0;
    }
    CHECK(wrong > 0);
}
