#include "core/shapes/solve.hpp"
#include "tests/oracle/first_hit.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;
using ray_sets::Set;

/// Rays of small integers are tangent to shapes and meet rims and edges exactly. The same rays with
/// unit directions, as cameras make them, almost do.
namespace {

#ifdef RAYLANE_FEW_RAYS
constexpr int shape_count = 300;
#else
constexpr int shape_count = 6'000;
#endif
constexpr int rays_per_shape = 20;

struct Tally {
    int rays = 0, doubtful = 0, hits = 0;
    int invented = 0, lost = 0, otherwise = 0, misplaced = 0;
};

std::vector<oracle::Hit> ahead(std::vector<oracle::Hit> hits) {
    std::erase_if(hits, [](const oracle::Hit& hit) { return hit.t <= 0; });
    std::sort(hits.begin(), hits.end(), [](const oracle::Hit& a, const oracle::Hit& b) {
        const int order = compare(a, b);
        return order != 0 ? order < 0 : a.entering && !b.entering;
    });
    return hits;
}

/// Compares all crossings ahead with the oracle's, if double was in doubt. Other tests check the
/// rest.
template <class Shape>
void compare(const Shape& shape, const Ray<double>& ray, Tally& tally) {
    ++tally.rays;
    std::uint64_t widened = 0;
    const Crossings<double> solved = solve(shape, ray, Start{}, widened);
    if (widened == 0) return;
    ++tally.doubtful;

    const std::vector<oracle::Hit> truth = ahead(oracle::crossings(shape, ray));
    std::vector<Crossing<double>> found;
    for (const Crossing<double>& crossing : solved)
        if (crossing.t > 0.0) found.push_back(crossing);
    tally.hits += truth.empty() ? 0 : 1;
    tally.invented += found.size() > truth.size() ? 1 : 0;
    tally.lost += found.size() < truth.size() ? 1 : 0;
    for (std::size_t i = 0; i < std::min(found.size(), truth.size()); ++i) {
        tally.otherwise += found[i].entering != truth[i].entering ? 1 : 0;
        const auto t = truth[i].t.template convert_to<double>();
        tally.misplaced += std::abs(found[i].t - t) <= needed_accuracy * t ? 0 : 1;
    }
}

Ray<double> unit(const Ray<float>& ray) {
    return {convert<double>(ray.origin), normalized(convert<double>(ray.direction))};
}

template <class Shape>
int count_ahead(const Shape& shape, const Vec3d& origin, const Vec3d& direction) {
    std::uint64_t widened = 0;
    int count = 0;
    for (const Crossing<double>& crossing :
         solve(shape, Ray<double>{origin, direction}, Start{}, widened))
        count += crossing.t > 0.0 ? 1 : 0;
    return count;
}

} // namespace

TEMPLATE_TEST_CASE("crossings in small integers agree with the oracle", "", RAYLANE_ALL_SHAPES) {
    using Shape = TestType;
    Random random(20260500 + static_cast<int>(kind_of<Shape>));
    Tally integers, units;
    for (int i = 0; i < shape_count; ++i) {
        const auto shape = ray_sets::Target<Shape>::make(random, true);
        for (int j = 0; j < rays_per_shape; ++j) {
            Ray<float> ray = ray_sets::make_ray(shape, Set::lattice, random);
            if (j % 2 == 0) ray.origin = random.small_integers(6);
            compare(shape, {convert<double>(ray.origin), convert<double>(ray.direction)}, integers);
            compare(shape, unit(ray), units);
        }
    }
    for (const Tally& tally : {integers, units}) {
        INFO(tally.rays << " rays, " << tally.doubtful << " doubtful, " << tally.hits << " hits");
        CHECK(tally.invented == 0);
        CHECK(tally.lost == 0);
        CHECK(tally.otherwise == 0);
        CHECK(tally.misplaced == 0);
        if (tests::is_bounded<Shape>) CHECK(tally.hits > tally.rays / 2000);
    }
}

TEST_CASE("a line that touches a cone only beyond its end does not cross it") {
    // The line touches the cone's extension at t = 0. Double-double cannot locate that root.
    const Vec3d origin{0, 2, 5}, direction = normalized(Vec3d(1, 3, -3));
    const CappedCone cone{{2, 2, -1}, {-1, 0, 0}, 0, 3};
    CHECK(oracle::crossings(cone, Ray<double>{origin, direction}).empty());
    CHECK(count_ahead(cone, origin, direction) == 0);
}

TEST_CASE("a line that passes a sphere by 1e-31 misses it") {
    // (-4, 3, 0) / 5 in double is off by 4e-17, so that the line is off the tangent by about the
    // square of that.
    const Vec3d origin{6, -6, 1}, direction = normalized(Vec3d(-4, 3, 0));
    CHECK(count_ahead(Sphere{{-2, 0, 3}, 2}, origin, direction) == 0);
    CHECK(count_ahead(Sphere{{-2, 0, 3}, 2}, origin, {-4, 3, 0}) == 2); // it touches
}

TEST_CASE("a ray with infinite or NaN numbers crosses nothing and its solver ends") {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
        CHECK(count_ahead(CappedCone{{0, 0, 0}, {0, 0, 1}, 1, 0}, {bad, 0, 0}, {0, 0, 1}) == 0);
        CHECK(count_ahead(Quadric{{}, 1, 1, 1, 0, 0, 0, 0, 0, 0, -1, Vec3f(-1), Vec3f(1)},
                          {0, 0, 0}, {bad, 0, 1}) == 0);
    }
}
