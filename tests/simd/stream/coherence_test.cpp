#include "core/numbers/infinity.hpp"
#include "simd/isa/isa.hpp"
#include "simd/units/kernels.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"

#include <string>
#include <vector>

/// The property that a caller's rays share, by which the engine chooses their traversal.
using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;

namespace {

/// Rays in a scene of radius 1.
struct TakenRays {
    static constexpr std::size_t count = 1024, padding = 16;
    std::vector<double> origin[3], direction[3], t_limit;

    /// Rays from origin_of(i) along direction_of(origin), which end at `limit`.
    template <class OriginOf, class DirectionOf>
    TakenRays(const OriginOf& origin_of, const DirectionOf& direction_of,
              double limit = infinity<double>)
        : t_limit(count + padding, limit) {
        for (std::size_t i = 0; i < count + padding; ++i) {
            const Vec3d from = origin_of(i), along = direction_of(from);
            for (int axis = 0; axis < 3; ++axis) {
                origin[axis].push_back(from[axis]);
                direction[axis].push_back(along[axis]);
            }
        }
    }

    /// Returns false if the first `ray_count` rays share no property.
    bool find(Isa isa, std::size_t ray_count, Coherence& coherence) {
        StreamRays rays{};
        rays.t_limit = t_limit.data();
        for (int axis = 0; axis < 3; ++axis) {
            rays.origin[axis] = origin[axis].data();
            rays.direction[axis] = rays.exact_direction[axis] = direction[axis].data();
        }
        return kernels_of(isa).stream.find_coherence(ray_count, rays, 1.0F, 0.5F, coherence);
    }
};

} // namespace

TEST_CASE("rays from near origins are coherent, whatever their directions") {
    Random random(7);
    const auto any = [&] {
        return Vec3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                     random.uniform(-1.0, 1.0));
    };
    const auto anywhere = [&](std::size_t) { return any(); };
    // Some rays start at another place, as behind a silhouette.
    const auto near = [&](std::size_t i) {
        return i % 8 == 0 ? any() : Vec3d(0.5, 0.2, 0.1) + 0.001 * any();
    };
    const auto near_thrice = [&](std::size_t i) { return near(i % 5 < 2 ? 0 : 1); };
    // Steps of a third of the scene, as of rays off surfaces far apart from each other.
    const auto spread = [&](std::size_t) { return 0.2 * any(); };
    const auto any_direction = [&](const Vec3d&) { return any(); };
    const auto to_light = [](const Vec3d& from) { return Vec3d(3.0, 4.0, 5.0) - from; };
    for (const Isa isa : available_isas()) {
        CAPTURE(std::string(name_of(isa)));
        Coherence coherence;
        CHECK_FALSE(TakenRays(anywhere, any_direction).find(isa, 1024, coherence));
        CHECK_FALSE(TakenRays(near_thrice, any_direction).find(isa, 1024, coherence));
        REQUIRE(TakenRays(spread, any_direction).find(isa, 1024, coherence));
        CHECK(coherence.scattered);

        TakenRays scattered(near, any_direction);
        REQUIRE(scattered.find(isa, 1024, coherence));
        CHECK(coherence.loose);
        CHECK(coherence.scattered);
        CHECK_FALSE(scattered.find(isa, 64, coherence)); // too few to pay

        REQUIRE(TakenRays(near, to_light, 1.0).find(isa, 1024, coherence));
        CHECK(coherence.converging);
        CHECK_FALSE(coherence.scattered);
        REQUIRE(TakenRays(anywhere, to_light, 1.0).find(isa, 1024, coherence));
        CHECK(coherence.converging);
        CHECK(coherence.scattered);
    }
}
