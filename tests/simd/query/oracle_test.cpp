#include "simd/isa/isa.hpp"
#include "simd/query/as_core.hpp"
#include "simd/query/transparency_walk.hpp"
#include "tests/oracle/first_hit.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/ray_sets.hpp"
#include "tests/support/rounds.hpp"

#include <algorithm>
#include <cmath>

using namespace raylane;
using namespace raylane::core;
using namespace raylane::simd;
using ray_sets::Random;
using ray_sets::Set;

/// Compares the engine, with its default of exact, with the oracle: which shape a ray hits, whether
/// it enters, t, and the point. RAYLANE_TEST_ROUNDS=4600 makes ten million rays.

namespace {

constexpr std::size_t rays_a_scene = 25;
constexpr int shapes_a_scene = 3;

struct Tally {
    std::size_t rays = 0, hits = 0, wrong = 0;
    std::uint64_t left = 0;                     ///< rays left to the scalar reference
    std::vector<double> t_errors, point_errors; ///< in ulps of float

    static double at(std::vector<double>& values, double share) {
        std::sort(values.begin(), values.end());
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    }
};

/// Returns the ulp of a float of that size.
double ulp(double value) {
    return std::ldexp(1.0, std::max(std::ilogb(value), -126) - 23);
}

double distance(double a, const oracle::Number& b) {
    return std::abs(static_cast<double>(oracle::Number(oracle::Number(a) - b)));
}

template <class Shape>
class Trial {
  public:
    Trial(Set set, Random& random) {
        SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        for (int i = 0; i < shapes_a_scene; ++i) {
            shapes_.push_back(ray_sets::Target<Shape>::make(random, set == Set::lattice));
            builder.add(shapes_.back(), 0);
        }
        scene_.emplace(std::move(builder).build());
        arena_ = arena_for([&](Arena& a) { paths_.take_from(a, rays_a_scene, false); });
        paths_.count = rays_a_scene;
        paths_.start_nowhere(0, rays_a_scene);
        for (std::size_t i = 0; i < rays_a_scene; ++i) {
            const Ray<float> aimed = ray_sets::make_ray(
                shapes_[static_cast<std::size_t>(random.integer(0, shapes_a_scene - 1))], set,
                random);
            const Vec3d origin = convert<double>(aimed.origin);
            const Vec3d direction = normalized(convert<double>(aimed.direction));
            for (int axis = 0; axis < 3; ++axis) {
                paths_.origin[axis][i] = origin[axis];
                paths_.direction[axis][i] = direction[axis];
            }
        }
    }

    void trace(const Kernels& kernels, Tally& tally) const {
        const SceneData data(*scene_);
        TransparencyWalk finder(data, {&kernels, Precision::exact});
        const Arena arena = arena_for([&](Arena& a) { finder.take_from(a, rays_a_scene); });
        EngineCounters counters;
        finder.nearest(paths_, nullptr, counters);
        tally.left += counters.doubtful;
        for (std::size_t i = 0; i < rays_a_scene; ++i)
            compare(finder, data, i, tally);
    }

  private:
    void compare(const TransparencyWalk& finder, const SceneData& data, std::size_t i,
                 Tally& tally) const {
        const Hits& hits = finder.hits();
        const Ray<double> ray = ray_of(paths_, i);
        std::optional<oracle::Hit> truth;
        ShapeId id = no_shape;
        bool touches = false; // several shapes at one point
        for (ShapeId k = 0; k < shapes_a_scene; ++k) {
            const std::optional<oracle::Hit> hit = oracle::first_hit(shapes_[k], ray);
            if (!hit) continue;
            const int order = truth ? oracle::compare(*hit, *truth) : -1;
            touches = order == 0 || (touches && order > 0);
            if (order > 0 || (order == 0 && hit->entering <= truth->entering)) continue;
            truth = hit;
            id = k;
        }
        ++tally.rays;
        // The engine leaves rays to the reference where surfaces touch.
        const std::span<const std::uint32_t> contacts = finder.at_contacts();
        const bool at_contacts = std::find(contacts.begin(), contacts.end(), i) != contacts.end();
        const bool hit = hits.slot[i] != no_slot;
        const bool same_side = truth && ((hits.hit[i] & hit_entering) != 0) == truth->entering;
        if (at_contacts != touches || hit != truth.has_value() ||
            (hit && (!same_side || data.record_of(hits.slot[i]).id != id))) {
            ++tally.wrong;
            return;
        }
        if (!hit) return;
        ++tally.hits;
        const double t = hits.t[i];
        tally.t_errors.push_back(distance(static_cast<double>(static_cast<float>(t)), truth->t) /
                                 ulp(static_cast<double>(truth->t)));
        double off = 0.0, largest = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const oracle::Number right =
                oracle::Number(ray.origin[axis]) + truth->t * oracle::Number(ray.direction[axis]);
            off = std::max(off, distance(ray.origin[axis] + t * ray.direction[axis], right));
            largest = std::max(largest, std::abs(static_cast<double>(right)));
        }
        // Errors of double itself do not count: they are large if a ray comes from far away and
        // hits near the origin.
        const double start = length(ray.origin) + t;
        tally.point_errors.push_back(off <= 0x1p-50 * start ? 0.0 : off / ulp(largest));
    }

    std::vector<Shape> shapes_;
    std::optional<Scene> scene_;
    Arena arena_;
    Paths paths_{};
};

} // namespace

TEMPLATE_TEST_CASE("the engine decides in the same way as the oracle", "[long]",
                   RAYLANE_ALL_SHAPES) {
    const Kernels& kernels = kernels_of(best_isa());
    Random random(20261100 + static_cast<std::uint64_t>(kind_of<TestType>));
    for (const Set set : ray_sets::all_sets) {
        Tally tally;
        for (int i = 0; i < tests::rounds(60, 5); ++i)
            Trial<TestType>(set, random).trace(kernels, tally);
        REQUIRE(tally.hits > tally.rays / 100);
        const double t_99 = Tally::at(tally.t_errors, 0.99), t_max = Tally::at(tally.t_errors, 1);
        const double point_99 = Tally::at(tally.point_errors, 0.99),
                     point_max = Tally::at(tally.point_errors, 1);
        const char* const name = ray_sets::set_names[static_cast<int>(set)].data();
        CAPTURE(name, tally.rays, tally.hits, tally.left, t_99, t_max, point_99, point_max);
        CHECK(tally.wrong == 0);
        CHECK(t_99 <= 0.5);
        CHECK(t_max <= 1.0);
        CHECK(point_max <= 1.0);
    }
}
