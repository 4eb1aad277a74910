#pragma once

#include "bench/random_shapes.hpp"
#include "core/reference/search.hpp"
#include "simd/query/query.hpp"
#include "tests/support/ray_sets.hpp"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

/// A dozen shapes of one kind, rays at them, and the true hits of these, to measure raylane's
/// precisions and other ray tracers.
namespace raylane::bench {

inline constexpr std::size_t method_ray_count = 4096;
inline constexpr int method_shape_count = 12;

/// The true crossing, which core::Searcher<double> finds and certifies, or the one that a method
/// found.
struct Crossed {
    std::uint32_t slot = simd::no_slot;
    bool entering = false;
    double t = 0.0;
};

/// Returns the name of a kind of shape within a benchmark's name.
template <class Shape>
std::string benchmark_name() {
    std::string name(name_of(core::kind_of<Shape>));
    for (char& c : name)
        if (c == ' ') c = '_';
    return name;
}

/// `hard`: rays of the hard sets; otherwise random ones. Rays are the engine's: their directions
/// are in double, so errors that a method makes by rounding them count.
template <class Shape, bool hard>
struct MethodRays {
    core::Scene scene;
    simd::SceneData data{scene};
    simd::Arena arena;
    simd::Paths paths{};
    std::vector<Crossed> truths; ///< by ray

    static const MethodRays& get() {
        static const MethodRays only;
        return only;
    }

    Shape shape(int i) const {
        return std::get<core::Table<Shape>>(scene.shapes()).blocks()[0].get(i);
    }

  private:
    using Random = ray_sets::Random;

    explicit MethodRays(Random random = Random(static_cast<std::uint64_t>(core::kind_of<Shape>) +
                                               1))
        : scene(make(random)) {
        using namespace core;
        arena =
            simd::arena_for([&](simd::Arena& a) { paths.take_from(a, method_ray_count, false); });
        paths.count = method_ray_count;
        paths.start_nowhere(0, method_ray_count);
        Searcher<double> searcher(scene, Search::every_shape);
        for (std::size_t i = 0; i < method_ray_count; ++i) {
            const auto set =
                hard ? ray_sets::all_sets[random.integer(1, 6)] : ray_sets::Set::random;
            const Ray<float> aimed =
                ray_sets::make_ray(shape(random.integer(0, method_shape_count - 1)), set, random);
            const Ray<double> ray{convert<double>(aimed.origin),
                                  normalized(convert<double>(aimed.direction))};
            for (int axis = 0; axis < 3; ++axis) {
                paths.origin[axis][i] = ray.origin[axis];
                paths.direction[axis][i] = ray.direction[axis];
            }
            const Hit<double> hit =
                searcher.nearest(ray, {}, [](const Hit<double>&) { return true; }).hit;
            truths.push_back({hit.any() ? data.slot_of(hit.kind, hit.place) : simd::no_slot,
                              hit.entering, hit.t});
        }
    }

    static core::Scene make(Random& random) {
        core::SceneBuilder builder;
        builder.wants_light = false;
        builder.add_material({});
        for (int i = 0; i < method_shape_count; ++i)
            builder.add(ray_sets::Target<Shape>::make(random, false), 0);
        return std::move(builder).build();
    }
};

/// Sets the counters of a benchmark that has found `found`, by ray. `wrong`: share of the rays that
/// hit something other than the truth. ulps_median, ulps_p99 and ulps_max: errors of the floats
/// nearest to t, for the others.
void report_errors(benchmark::State& state, const std::vector<Crossed>& truths,
                   const std::vector<Crossed>& found);

} // namespace raylane::bench
