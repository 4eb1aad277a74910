#include "core/hierarchy/refit.hpp"
#include "core/scene/built_shapes.hpp"
#include "core/scene/scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace raylane;
using namespace raylane::core;
using ray_sets::Random;

/// Tests of the hierarchy of scenes whose spheres have moved. scenes/api/moved_scenes_test.cpp
/// compares the answers.

namespace {

std::vector<float> cloud(Random& random, int count) {
    std::vector<float> coordinates;
    for (int i = 0; i < 3 * count; ++i)
        coordinates.push_back(static_cast<float>(random.uniform(0.0, 1.0)));
    return coordinates;
}

Scene built(const std::vector<float>& at, float radius, std::size_t pack_from = packed_from) {
    SceneBuilder builder;
    builder.wants_light = false;
    builder.pack_from = pack_from;
    builder.add_material({});
    for (std::size_t i = 0; i < at.size(); i += 3)
        builder.add(Sphere{{at[i], at[i + 1], at[i + 2]}, radius}, 0);
    return std::move(builder).build();
}

Scene moved(const Scene& scene, const std::vector<float>& coordinates) {
    Workers alone;
    return scene.with_positions(std::span<const float>(coordinates), alone);
}

/// Returns the expected number of nodes and blocks that a ray through the root's bounds visits.
double cost_of(const Scene& scene) {
    std::vector<float> costs;
    add_costs(scene.hierarchy().nodes, costs);
    return static_cast<double>(costs.front());
}

} // namespace

TEST_CASE("rays through spheres that drift or are shuffled visit little more than in a new tree") {
    Random random(5);
    const int count = tests::rounds(20'000, 3000);
    const float radius = 0.3F / std::cbrt(static_cast<float>(count));
    const std::vector<float> first = cloud(random, count);
    const Scene scene = built(first, radius);
    for (const double drift : {0.1, 1.0, 10.0, 1000.0}) {
        CAPTURE(drift);
        Scene chain = scene;
        std::vector<float> at = first;
        for (int step = 0; step < 5; ++step) {
            for (float& x : at)
                x += static_cast<float>(random.uniform(-drift, drift)) * radius;
            chain = moved(chain, at);
            CHECK(cost_of(chain) < 1.35 * cost_of(built(at, radius)));
        }
    }
}
