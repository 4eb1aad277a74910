#include "core/reference/search.hpp"
#include "core/shapes/bounds.hpp"
#include "core/shapes/shapes.hpp"
#include "tests/oracle/first_hit.hpp"
#include "tests/simd/stream/stream_columns.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/sanitized.hpp"

#include <cmath>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;
using ray_sets::Set;
using tests::RayAnswers;
using tests::StreamColumns;

/// Streams of rays that almost miss a shape's bounds, or the shape itself.
namespace {

constexpr int of_each_kind = tests::sanitized ? 6 : 40;

/// Returns the furthest along an axis of many random points of the surface.
template <class Shape>
Vec3d furthest(const Shape& shape, int axis, double side, Random& random) {
    Vec3d best = ray_sets::Target<Shape>::surface(shape, random).point;
    for (int i = 0; i < 100; ++i) {
        const Vec3d point = ray_sets::Target<Shape>::surface(shape, random).point;
        if (side * point[axis] > side * best[axis]) best = point;
    }
    return best;
}

/// Returns a ray along a face of a shape's bounds, up to some ulps in front of it or behind it.
template <class Shape>
Ray<float> along_bounds(const Shape& shape, Random& random) {
    const int axis = random.integer(0, 2);
    const bool upper = random.integer(0, 1) == 0;
    const Bounds bounds = bounds_of(shape);
    const Vec3d target = furthest(shape, axis, upper ? 1.0 : -1.0, random);
    Vec3d direction = random.direction();
    constexpr double little[] = {0.0, -0.0, 1e-40, -1e-40, 1e-9, -1e-9};
    direction[axis] = little[random.integer(0, 5)];
    if (random.integer(0, 1) == 0) direction[(axis + 1) % 3] = 0.0;
    if (squared_length(direction) < 1e-6) direction[(axis + 2) % 3] = 1.0;
    Vec3f origin = ray_sets::rounded(target - random.uniform(0.0, 9.0) * direction);
    origin[axis] = upper ? bounds.upper[axis] : bounds.lower[axis];
    for (int step = random.integer(-8, 2); step != 0; step += step < 0 ? 1 : -1)
        origin[axis] =
            std::nextafter(origin[axis], (step > 0) == upper ? infinity<float> : -infinity<float>);
    return {origin, ray_sets::rounded(direction)};
}

template <class Shape>
void add_kind(SceneBuilder& builder, bool lattice, Random& random, StreamColumns& rays) {
    for (int i = 0; i < of_each_kind; ++i) {
        const auto shape = ray_sets::Target<Shape>::make(random, lattice);
        builder.add(shape, 0);
        for (int j = 0; j < 8; ++j)
            rays.add(along_bounds(shape, random));
        for (const Set set : ray_sets::all_sets)
            if ((set == Set::lattice) == lattice) rays.add(ray_sets::make_ray(shape, set, random));
    }
}

int ulps_apart(float a, float b) {
    int steps = 0;
    for (; a != b && steps < 9; ++steps)
        a = std::nextafter(a, b);
    return steps;
}

} // namespace

TEST_CASE("traversal and brute force agree on rays along the faces of bounds", "[long]") {
    for (const bool lattice : {false, true}) {
        Random random(lattice ? 41 : 40);
        SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        StreamColumns rays;
        for_each_shape_type([&]<class Shape>(std::type_identity<Shape>) {
            if constexpr (tests::is_bounded<Shape>) add_kind<Shape>(builder, lattice, random, rays);
        });
        const Scene scene = std::move(builder).build();
        const RayAnswers answers(StreamTracer(scene), rays.view());

        Searcher<double> by_trying(scene, Search::every_shape);
        Searcher<double> by_hierarchy(scene, Search::hierarchy);
        const auto any_hit = [](const Hit<double>&) { return true; };
        int hits = 0, wrong = 0, lost_by_reference = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Hit<double> truth = by_trying.nearest(rays.get(i), {}, any_hit).hit;
            const Hit<double> found = by_hierarchy.nearest(rays.get(i), {}, any_hit).hit;
            hits += truth.any() ? 1 : 0;
            lost_by_reference += found.shape == truth.shape && found.t == truth.t ? 0 : 1;
            const float t = truth.any() ? static_cast<float>(truth.t) : infinity<float>;
            wrong += answers.shape[i] == truth.shape && answers.t[i] == t ? 0 : 1;
        }
        INFO(rays.size() << " rays, " << hits << " hits");
        CHECK(wrong == 0);
        CHECK(lost_by_reference == 0);
        CHECK(hits > static_cast<int>(rays.size()) / 3);
    }
}

TEMPLATE_LIST_TEST_CASE(
    "the vector engine finds the entry and the exit of a solid and no third hit", "[long]",
    tests::AllSolids) {
    using Shape = TestType;
    CAPTURE(name_of(kind_of<Shape>));
    Random random(20260700 + static_cast<int>(kind_of<Shape>));
    int through = 0, wrong = 0, misplaced = 0;
    for (int i = 0; i < 4 * of_each_kind; ++i) {
        const bool lattice = i % 2 == 1;
        const auto shape = ray_sets::Target<Shape>::make(random, lattice);
        SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        builder.add(shape, 0);
        const Scene scene = std::move(builder).build();
        StreamColumns rays;
        for (const Set set : ray_sets::all_sets)
            for (int j = 0; j < 4; ++j)
                if ((set == Set::lattice) == lattice || set == Set::zeros)
                    rays.add(ray_sets::make_ray(shape, set, random));
        rays.t_min.resize(rays.size());

        const StreamTracer tracer(scene, 1);
        std::vector<std::vector<float>> found(rays.size());
        for (int round = 0; round < 3; ++round) {
            const RayAnswers answers(tracer, rays.view());
            for (std::size_t k = 0; k < rays.size(); ++k) {
                if (answers.shape[k] == no_shape) continue;
                found[k].push_back(answers.t[k]);
                rays.t_min[k] = answers.t[k];
            }
        }
        for (std::size_t k = 0; k < rays.size(); ++k) {
            std::vector<float> truth;
            for (const oracle::Hit& hit : oracle::crossings(shape, rays.get(k)))
                if (hit.t > 0) truth.push_back(hit.t.template convert_to<float>());
            through += truth.size() == 2 ? 1 : 0;
            // If both are one float, or neighbours, there may be no second hit.
            const bool touches = truth.size() == 2 && ulps_apart(truth[0], truth[1]) <= 1;
            if (found[k].size() != truth.size() && !(touches && found[k].size() == 1)) ++wrong;
            if (found[k].size() != truth.size()) continue;
            for (std::size_t n = 0; n < truth.size(); ++n)
                misplaced += ulps_apart(found[k][n], truth[n]) <= 1 ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(misplaced == 0);
    CHECK(through > of_each_kind);
}
